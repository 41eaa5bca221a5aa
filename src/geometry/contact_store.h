#pragma once

#include <memory>
#include <vector>

#include "kernels/screen/contact_history.h"
#include "probegi/render.h"

namespace probegi {

/// Records where a backend has them.
struct ContactStore {
    virtual ~ContactStore() = default;
};

/// One picture's contact light, for the next one. Empty: there is none.
struct ContactHistory::Impl {
    int width = 0, height = 0;  ///< pixels
    kernels::PinholeCamera camera{};
    std::vector<kernels::ContactRecord> records;  ///< row-major; of a picture on the CPU
    std::unique_ptr<ContactStore> store;          ///< of one on another backend
    int pictures = 0;                             ///< 0..255, then again: numbers the noise of the next one

    /// Whether it is of a picture of this size.
    bool fits(const PictureDesc& desc) const noexcept { return width == desc.width && height == desc.height; }
    /// After a picture.
    void keep(const PictureDesc& desc, const kernels::PinholeCamera& of) noexcept;
};

}  // namespace probegi
