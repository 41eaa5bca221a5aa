#pragma once

#include "probegi/vulkan/device.h"
#include "probegi/vulkan/recording.h"
#include "probegi/vulkan/standalone.h"

/// The Vulkan 1.3 backend. Two ways in:
///
/// An engine hands over its device (Device::adopt) and records passes into its own command buffers: GpuField,
/// GpuScene, GpuLighting. Recording never submits, waits or maps memory; the barriers between the library's own passes
/// are recorded with them, and each record function says what the caller must order before and after it. Record outside
/// of render passes; compute pipeline, descriptor sets and push constants of the command buffer are not kept. What a
/// command buffer uses must live until it has finished.
///
/// A program without a device opens one (Device::open) and uses the CPU backend's API on the GPU: makeTracer(),
/// makeMovableTracer(), makeField(), renderPicture(), or all of them through makeBackend(). These submit and wait.
///
/// Each half has a header of its own: probegi/vulkan/recording.h and standalone.h.
namespace probegi::vulkan {}
