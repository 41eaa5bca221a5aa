#include "sdf/fit/fit_looks.h"

#include <algorithm>
#include <glm/common.hpp>
#include <map>
#include <numeric>

#include "sdf/fit/face_sums.h"
#include "sdf/fit/sdf_accuracy.h"

namespace probegi {

namespace {

/// Sums over the rays that meet a primitive.
struct Seen {
    glm::vec3 albedo{0.0f}, emission{0.0f};
    FaceSums faces;
    int near = 0;  ///< rays that meet the scene's surface beside it
    int all = 0;
    std::map<int, int> materials;  ///< of the near ones
};

std::string materialName(const Seen& seen, const Scene& scene) {
    const auto most = std::max_element(seen.materials.begin(), seen.materials.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == seen.materials.end() || most->first < 0) return "box";
    const std::string& name = scene.materials[std::size_t(most->first)].name;
    return name.empty() ? "box" : name;
}

}  // namespace

void giveLooks(std::vector<SdfPrimitive>& primitives, std::span<const kernels::SdfSolid> solids, std::size_t fixed,
               const FitRays& walked, float near, const Scene& scene) {
    std::vector<Seen> seen(primitives.size());
    for (std::size_t i = 0; i < walked.rays.size(); ++i) {
        const FitRay& ray = walked.rays[i];
        int number = -1;
        const float distance = entersUnion(solids, ray, number);
        if (number < 0) continue;
        Seen& of = seen[std::size_t(number)];
        ++of.all;
        if (ray.distance >= kFitSky || std::abs(distance - ray.distance) * ray.cosine > near) continue;
        const FitSurface& surface = walked.surfaces[i];
        of.albedo += surface.albedo;
        of.emission += surface.emission;
        of.faces.add(solids[std::size_t(number)], ray.origin + ray.direction * distance, surface.albedo);
        ++of.near;
        ++of.materials[surface.material];
    }
    std::map<std::string, int> used;
    std::vector<std::size_t> order(primitives.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin() + std::ptrdiff_t(fixed), order.end(),
                     [&](std::size_t a, std::size_t b) { return seen[a].all > seen[b].all; });
    std::vector<SdfPrimitive> sorted;
    for (const std::size_t from : order) {
        SdfPrimitive& p = sorted.emplace_back(std::move(primitives[from]));
        if (from < fixed) continue;
        const Seen& of = seen[from];
        if (of.near > 0) {
            p.albedo = glm::clamp(of.albedo / float(of.near), 0.0f, 1.0f);
            p.faces = of.faces.means(p.albedo);
            p.emission = of.emission / float(of.near);
        }
        const std::string name = materialName(of, scene);
        p.name = name + " " + std::to_string(++used[name]);
    }
    primitives = std::move(sorted);
}

}  // namespace probegi
