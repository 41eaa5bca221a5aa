#include "vulkan/picture/gpu_contact.h"

#include "field/contact_reach.h"
#include "kernels/screen/contact_light.h"

namespace probegi::vulkan {

/// Records of the picture before, on its device.
struct GpuContact::Store : ContactStore {
    Store(Device on, Buffer its) : device(std::move(on)), records(std::move(its)) {}
    Device device;
    Buffer records;
};

GpuContact::GpuContact(const GpuPicture& picture, int frameRows, const kernels::PinholeCamera& camera)
    : m_desc(picture.desc), m_device(picture.device), m_camera(camera) {
    const bool keeps = keepsContact(m_desc);
    const std::size_t pixels = std::size_t(frameRows) * std::size_t(m_desc.width);
    const std::size_t found = pixels * sizeof(kernels::ContactFound), light = pixels * sizeof(glm::vec4);
    m_values = Buffer(m_device.impl(), "contact light", found + (keeps ? 2 : 1) * light, kAddressed);
    m_block.found = packAddress(m_values.address());
    m_block.blurred = packAddress(m_values.address() + found);
    m_block.kept = packAddress(m_values.address() + found + (keeps ? light : 0));
    m_block.reach = contactReach(m_desc, picture.field, picture.bounds);
    m_block.rows = m_desc.height;
    m_block.limited = picture.field ? 1 : 0;
    if (!keeps) return;
    const ContactHistory::Impl& history = m_desc.contactHistory->impl();
    const auto* store = dynamic_cast<const Store*>(history.store.get());
    if (store && history.fits(m_desc) && &store->device.impl() == &m_device.impl()) {
        m_block.past = packAddress(store->records.address());
        m_block.camera = history.camera;
    }
    m_block.round = history.pictures * planeCount(m_desc);
    m_records =
        Buffer(m_device.impl(), "contact history",
               std::size_t(m_desc.width) * std::size_t(m_desc.height) * sizeof(kernels::ContactRecord), kAddressed);
    m_block.records = packAddress(m_records.address());
}

void GpuContact::remember() {
    if (!m_records) return;
    ContactHistory::Impl& history = m_desc.contactHistory->impl();
    auto store = std::make_unique<Store>(m_device, std::move(m_records));
    history.keep(m_desc, m_camera);
    history.records.clear();
    history.store = std::move(store);
}

}  // namespace probegi::vulkan
