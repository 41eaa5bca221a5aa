#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <set>

#include "io/gltf_accessor.h"
#include "io/gltf_import.h"

namespace probegi::io {

namespace {

std::optional<AnimationPath> pathOf(Import& import, const std::string& user, const std::string& path) {
    if (path == "translation") return AnimationPath::translation;
    if (path == "rotation") return AnimationPath::rotation;
    if (path == "scale") return AnimationPath::scale;
    import.warn(path == "weights" ? fmt::format("{}: morph target weights are not supported and are not animated", user)
                                  : fmt::format("{}: the animation of an unknown property is ignored", user));
    return {};
}

Interpolation interpolationOf(Import& import, const std::string& user, const std::string& name) {
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubicSpline;
    if (name != "LINEAR") import.warn(fmt::format("{}: unknown interpolation; LINEAR is used", user));
    return Interpolation::linear;
}

void readTimes(Import& import, int input, AnimationChannel& channel) {
    const AccessorView view(import.model, input);
    if (view.components() != 1 || !view.isFloat()) refuseMalformed("key times are not floats");
    if (view.count() == 0) refuseMalformed("it has no keys");
    import.geometry.charge(view.count() * sizeof(float));
    channel.times.reserve(view.count());
    for (std::size_t i = 0; i < view.count(); ++i) {
        const float time = view.vector(i).x;
        if (!std::isfinite(time) || (i > 0 && time <= channel.times.back())) {
            refuseMalformed("key times must increase, but key {} is at {}", i, time);
        }
        channel.times.push_back(time);
    }
}

void readValues(Import& import, int output, AnimationChannel& channel) {
    const AccessorView view(import.model, output);
    const bool rotates = channel.path == AnimationPath::rotation;
    const bool cubic = channel.interpolation == Interpolation::cubicSpline;
    if (view.components() != (rotates ? 4 : 3)) refuseMalformed("its values have {} components", view.components());
    if (view.count() != channel.times.size() * (cubic ? 3 : 1)) {
        refuseMalformed("{} values for {} keys", view.count(), channel.times.size());
    }
    import.geometry.charge(view.count() * sizeof(glm::vec4));
    channel.values.reserve(view.count());
    for (std::size_t i = 0; i < view.count(); ++i) {
        glm::vec4 value = view.vector(i);
        const float length = glm::length(value);
        if (!std::isfinite(length)) refuseMalformed("value {} is not finite", i);
        if (rotates && (!cubic || i % 3 == 1)) {  // tangents of a spline are not rotations
            if (!(length > 1e-6f)) refuseMalformed("value {} is not a rotation", i);
            value /= length;
        }
        channel.values.push_back(value);
    }
}

/// Empty for a channel without visible effect in ProbeGI.
std::optional<AnimationChannel> importChannel(Import& import, const std::string& user,
                                              const tinygltf::Animation& animation,
                                              const tinygltf::AnimationChannel& c) {
    if (c.target_node < 0) return {};
    AnimationChannel channel;
    channel.node = import.nodes[checkedIndex("it", "node", c.target_node, import.nodes.size())];
    const std::optional<AnimationPath> path = pathOf(import, user, c.target_path);
    if (channel.node < 0 || !path) return {};
    if (import.scene().nodes[std::size_t(channel.node)].matrix) {
        import.warn(fmt::format("{}: a node with a matrix cannot be animated; the channel is ignored", user));
        return {};
    }
    const auto& samplers = animation.samplers;
    const tinygltf::AnimationSampler& sampler = samplers[checkedIndex("it", "sampler", c.sampler, samplers.size())];
    channel.path = *path;
    channel.interpolation = interpolationOf(import, user, sampler.interpolation);
    readTimes(import, sampler.input, channel);
    readValues(import, sampler.output, channel);
    return channel;
}

}  // namespace

void importAnimations(Import& import) {
    std::set<std::pair<int, AnimationPath>> animated;
    for (std::size_t a = 0; a < import.model.animations.size(); ++a) {
        const tinygltf::Animation& animation = import.model.animations[a];
        for (std::size_t c = 0; c < animation.channels.size(); ++c) {
            const std::string user = fmt::format("{}, channel {}", title("animation", a, animation.name), c);
            try {
                auto channel = importChannel(import, user, animation, animation.channels[c]);
                if (!channel) continue;
                if (animated.emplace(channel->node, channel->path).second) {
                    import.scene().animations.push_back(std::move(*channel));
                } else {
                    import.warn(fmt::format("{}: another channel already moves its node; this one is ignored",
                                            title("animation", a, animation.name)));
                }
            } catch (const Refused& refused) {
                refuse(refused.error.code, "{}: {}", user, refused.error.message);
            }
        }
    }
}

}  // namespace probegi::io
