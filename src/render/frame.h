#pragma once

#include <cstddef>
#include <memory>

#include "probegi/shared/screen_sample.h"

namespace probegi {

/// A rectangle of pixels of a picture.
struct PixelRect {
    int x = 0, y = 0;
    int width = 0, height = 0;

    std::size_t pixels() const noexcept { return std::size_t(width) * std::size_t(height); }
};

class ContactFrame;
class GlossyFrame;

/// The G-buffer of a rectangle of a picture: one plane of samples, one a pixel, row-major; or several planes, those of
/// a pixel side by side. The n-th plane has the n-th sub-sample of all pixels.
class Frame {
public:
    /// Of a picture with PictureDesc::glossy, as large as this; else null.
    GlossyFrame* glossy = nullptr;
    /// Of a picture with PictureDesc::contact, the same.
    ContactFrame* contact = nullptr;

    /// The frame is now there. Samples are not initialised: the first pass writes all, on the threads that use them
    /// next.
    void place(const PixelRect& rect, int firstPlane, int planes) {
        m_rect = rect;
        m_firstPlane = firstPlane;
        m_planes = planes;
        const std::size_t bytes = rect.pixels() * std::size_t(planes) * sizeof(ScreenSample);
        if (bytes <= m_bytes) return;
        // Nothing is kept meanwhile: if this throws, the frame is empty.
        m_storage = nullptr;
        m_bytes = 0;
        m_storage = std::make_unique_for_overwrite<std::byte[]>(bytes);
        m_bytes = bytes;
    }

    const PixelRect& rect() const noexcept { return m_rect; }
    int firstPlane() const noexcept { return m_firstPlane; }
    int endPlane() const noexcept { return m_firstPlane + m_planes; }

    /// Of a pixel of the picture that lies in rect().
    ScreenSample& at(int x, int y, int plane) noexcept {
        const std::size_t pixel = std::size_t(y - m_rect.y) * std::size_t(m_rect.width) + std::size_t(x - m_rect.x);
        return reinterpret_cast<ScreenSample*>(
            m_storage.get())[pixel * std::size_t(m_planes) + std::size_t(plane - m_firstPlane)];
    }

private:
    PixelRect m_rect;
    int m_firstPlane = 0, m_planes = 0;
    std::unique_ptr<std::byte[]> m_storage;
    std::size_t m_bytes = 0;
};

}  // namespace probegi
