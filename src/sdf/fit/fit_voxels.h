#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "probegi/context.h"
#include "sdf/fit/fit_rays.h"

namespace probegi {

/// A box along the axes of one of the fit's frames, metres.
struct FitBox {
    glm::vec3 lower{0.0f};
    glm::vec3 upper{0.0f};
    int frame = 0;
};

/// A grid over the places that rays pass through and end at: what a box would be worth that covers some of it. The
/// worth of a box is the weight of the rays that end in it, less a share of those that it would stop on their way;
/// places that no ray has seen are free.
class FitVoxels {
public:
    /// A grid of about `resolution` cubes along its longest side around the rays and their ends, in frame number
    /// `frame`, as whose coordinates those of the rays are.
    FitVoxels(std::span<const FitRay> rays, int resolution, int frame);

    /// Forgets all rays.
    void clear();
    /// Adds a ray that passes until `to` metres, and ends at `at` metres with a weight; weight 0: it does not end.
    void add(const FitRay& ray, float to, float at, float weight);
    /// Prepares for bestBox().
    void sum();
    struct Found {
        FitBox box;
        float worth = 0;  ///< 0: no box is worth anything
    };
    /// The box of the largest worth of those that grow from `seeds` random ends. The same for any number of threads.
    Found bestBox(const Context& context, int seeds, std::uint32_t& state) const;
    /// What a box covers is worth nothing more, and costs nothing. `toBox`: from this grid's frame to the box's. Needs
    /// sum() again if it returns true.
    bool cover(const FitBox& box, const glm::mat3& toBox);

    float cell() const noexcept { return m_cell; }

private:
    struct Range {
        glm::ivec3 lower;
        glm::ivec3 upper;  ///< exclusive
    };
    std::size_t index(glm::ivec3 v) const noexcept {
        return std::size_t(v.x) +
               std::size_t(m_counts.x) * (std::size_t(v.y) + std::size_t(m_counts.y) * std::size_t(v.z));
    }
    float worth(const Range& box) const noexcept;
    Range grown(glm::ivec3 from, float& worthOut) const;
    FitBox boxOf(const Range& range) const noexcept;

    glm::vec3 m_origin{0.0f};
    float m_cell = 1;
    int m_frame = 0;
    glm::ivec3 m_counts{1};
    std::vector<float> m_worth;       ///< of each cube
    std::vector<double> m_sums;       ///< inclusive, with a border of zeros
    std::vector<float> m_ends;        ///< weight of the rays that end in a cube
    std::vector<double> m_endsSoFar;  ///< running sum, by which seeds are drawn
};

}  // namespace probegi
