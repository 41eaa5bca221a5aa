#pragma once

#include "mask/halls.h"
#include "probegi/field_file.h"

namespace probegi::test {

/// A field of two volumes with nothing as by default, updated twice, with masks.
inline SavedField someField() {
    const Halls halls(0.17f);
    FieldDesc desc;
    desc.volumes = {{{-0.4f, 0.3f, -0.5f}, {0.7f, 0.8f, 0.9f}, {3, 2, 3}},
                    {{0.1f, 0.2f, 0.3f}, glm::vec3(0.5f), {2, 2, 2}, glm::angleAxis(0.3f, glm::vec3(0, 1, 0))}};
    desc.raysPerProbe = 40;
    desc.fixedRays = 12;
    desc.irradianceTexels = 4;
    desc.visibilityTexels = 6;
    desc.emitterSamples = 1;
    desc.relocation = true;
    desc.seed = 0x1234'5678'9abc'def0;
    FieldSettings settings{0.9f, 0.8f, 60.0f, 0.2f, 0.1f, 0.6f, BackfaceRule::excluded, LeakGuard::masks};
    settings.masks = halls.bake({.clusters = 5, .factor = 3}, desc);
    settings.camera = glm::vec3(1, 2, 3);
    settings.outside = OutsideLight::fades;
    settings.outsideRadiance = {0.1f, 0.2f, 0.3f};
    Field field = Field::create(halls.context, desc, settings).value();
    const Lighting lighting{{{.type = LightType::point, .position = {1, 2, 1}, .intensity = glm::vec3(3)}}, {}};
    for (int i = 0; i < 2; ++i) field.update(*halls.tracer, lighting).value();
    return {field.read().value(), settings, {"test 1.2", "halls", "--clusters 5", {7, 8}}, {{1, 2, 3}}};
}

}  // namespace probegi::test
