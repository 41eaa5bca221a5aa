#pragma once

#include "probegi/backend.h"
#include "probegi/vulkan/recording.h"

/// For programs without a renderer of their own: the CPU backend's API on the GPU. These calls submit and wait.
namespace probegi::vulkan {

/// A Backend on a device that is already open. Errors: unsupported (no ray query there).
PROBEGI_API Result<std::unique_ptr<Backend>> makeBackend(const Context& context, const Device& device,
                                                         TracerKind tracer = TracerKind::automatic);

/// Triangles traced on the GPU: closestHits(), occluded() and surfaces() upload, dispatch and wait, so large batches
/// are best; a Field of the same device traces without leaving the GPU. They fail with deviceLost or outOfMemory. The
/// scene must be valid and outlive the tracer. Errors: outOfMemory, unsupported.
PROBEGI_API Result<std::unique_ptr<Tracer>> makeTracer(const Context& context, const Device& device, const Scene& scene,
                                                       const ScenePose& pose, const GpuSceneDesc& desc = {});

/// The same for a scene in which things move: setPose() refits the top level on the GPU, and waits. Errors: those, and
/// invalidArgument (no such node in the scene).
PROBEGI_API Result<std::unique_ptr<MovableTracer>> makeMovableTracer(const Context& context, const Device& device,
                                                                     const Scene& scene, const ScenePose& pose,
                                                                     const MovableDesc& movable = {},
                                                                     TracerKind tracer = TracerKind::automatic);

/// Primitives traced on the GPU, as probegi::makeSdfTracer does on the CPU: the same hits. Errors: those, and
/// deviceLost.
PROBEGI_API Result<std::unique_ptr<MovableTracer>> makeSdfTracer(const Context& context, const Device& device,
                                                                 const SdfScene& sdf, const Scene& scene,
                                                                 const ScenePose& pose);

/// A Field whose passes run on the GPU. Its update() accepts any Tracer: with one of makeTracer() on the same device
/// everything stays on the GPU, with another the rays are traced and shaded by the CPU and uploaded.
/// Errors: as GpuField::create.
PROBEGI_API Result<Field> makeField(const Context& context, const Device& device, const FieldDesc& desc,
                                    const FieldSettings& settings = {});

/// GPU time of each pass of the field's last update and last batch of queries. Empty for other backends, or if the
/// device has no timestamps.
PROBEGI_API std::vector<PassTime> lastPassTimes(const Field& field);

/// As probegi::renderPicture, on the GPU: primary rays, direct light with shadow rays, query, accumulate. `tracer` must
/// be from makeTracer() and `field` (may be null) from makeField(), both on this device. Errors: invalidArgument (size;
/// tracer or field of another backend), outOfMemory, deviceLost, cancelled.
PROBEGI_API Result<RenderedPicture> renderPicture(const Context& context, const Device& device, const Tracer& tracer,
                                                  const Lighting& lighting, const Field* field,
                                                  const PictureDesc& desc);

/// Tone-maps to 8-bit sRGB on the GPU, four bytes per pixel. Errors: outOfMemory, deviceLost.
PROBEGI_API Result<std::vector<std::uint8_t>> toneMapImage(const Device& device, const HdrImage& image,
                                                           const ToneMap& toneMap);

}  // namespace probegi::vulkan
