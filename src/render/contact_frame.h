#pragma once

#include <vector>

#include "kernels/screen/contact_light.h"
#include "render/frame.h"

namespace probegi {

/// What the passes of PictureDesc::contact keep of one plane of a frame, a value a pixel.
class ContactFrame {
public:
    /// The frame is now there. Nothing is initialised: contactSearch writes all.
    /// `keeps`: the picture has a history.
    void place(const PixelRect& rect, bool keeps) {
        m_rect = rect;
        m_found.resize(rect.pixels());
        m_blurred.resize(rect.pixels());
        if (keeps) m_kept.resize(rect.pixels());
    }

    bool contains(int x, int y) const noexcept {
        return x >= m_rect.x && y >= m_rect.y && x < m_rect.x + m_rect.width && y < m_rect.y + m_rect.height;
    }

    /// What the search found.
    kernels::ContactFound& found(int x, int y) noexcept { return m_found[index(x, y)]; }
    glm::vec4& blurred(int x, int y) noexcept { return m_blurred[index(x, y)]; }
    /// Blurred, and with the history where there is one.
    glm::vec4& kept(int x, int y) noexcept { return (m_kept.empty() ? m_blurred : m_kept)[index(x, y)]; }

private:
    std::size_t index(int x, int y) const noexcept {
        return std::size_t(y - m_rect.y) * std::size_t(m_rect.width) + std::size_t(x - m_rect.x);
    }

    PixelRect m_rect;
    std::vector<kernels::ContactFound> m_found;
    std::vector<glm::vec4> m_blurred, m_kept;
};

}  // namespace probegi
