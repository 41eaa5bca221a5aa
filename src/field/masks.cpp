#include "probegi/masks.h"

#include "field/masks_impl.h"
#include "kernels/guards/masks.h"

namespace probegi {

Masks::Masks(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
Masks::~Masks() = default;

const std::vector<VolumeDesc>& Masks::volumes() const noexcept {
    return m_impl->volumes;
}
const MaskReport& Masks::report() const noexcept {
    return m_impl->report;
}
int Masks::clusters() const noexcept {
    return m_impl->clusters;
}
int Masks::factor() const noexcept {
    return m_impl->factor;
}
std::span<const std::uint32_t> Masks::words() const noexcept {
    return m_impl->words;
}
int Masks::cluster(int slot) const noexcept {
    return kernels::maskCluster(int(m_impl->words[2 * std::size_t(slot) + 1]));
}

}  // namespace probegi
