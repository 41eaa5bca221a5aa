#include "geometry/contact_store.h"

namespace probegi {

ContactHistory::ContactHistory() : m_impl(std::make_unique<Impl>()) {}
ContactHistory::ContactHistory(ContactHistory&&) noexcept = default;
ContactHistory& ContactHistory::operator=(ContactHistory&&) noexcept = default;
ContactHistory::~ContactHistory() = default;

void ContactHistory::Impl::keep(const PictureDesc& desc, const kernels::PinholeCamera& of) noexcept {
    width = desc.width;
    height = desc.height;
    camera = of;
    pictures = (pictures + 1) & 255;
}

void ContactHistory::forget() noexcept {
    m_impl->width = m_impl->height = 0;
    m_impl->records.clear();
    m_impl->store.reset();
}

}  // namespace probegi
