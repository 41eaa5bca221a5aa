#pragma once

#include "geometry/contact_store.h"
#include "kernels/abi/gpu_passes.h"
#include "vulkan/picture/gpu_picture.h"

namespace probegi::vulkan {

/// Buffers of PictureDesc::contact of one picture: values of a frame, and its history.
class GpuContact {
public:
    /// `frameRows`: of the largest frame. Throws.
    GpuContact(const GpuPicture& picture, int frameRows, const kernels::PinholeCamera& camera);

    /// What the shaders read.
    const kernels::ContactBlock& block() const noexcept { return m_block; }
    /// Once the picture is complete: what the next one must know of it.
    void remember();

private:
    struct Store;

    const PictureDesc& m_desc;
    Device m_device;
    kernels::PinholeCamera m_camera;
    Buffer m_values, m_records;
    kernels::ContactBlock m_block{};
};

}  // namespace probegi::vulkan
