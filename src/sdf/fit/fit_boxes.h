#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "probegi/context.h"
#include "sdf/fit/fit_rays.h"
#include "sdf/fit/fit_voxels.h"

namespace probegi {

/// What it costs that a ray ends at `distance` among the boxes rather than at the scene's surface.
struct FitCost {
    float usual = 0.1f;     ///< metres: errors grow dear up to about this one, and ever less beyond
    float leak = 16;        ///< of a ray that leaves where it should not
    float sky = 4;          ///< of a ray that meets what is not there, or begins inside a box
    float grazing = 0.25f;  ///< least cosine by which errors along the ray count

    float operator()(float wanted, float cosine, float distance) const noexcept {
        if (wanted >= kFitSky) return distance >= kFitSky ? 0.0f : sky;
        if (distance >= kFitSky) return leak;
        if (distance <= 0) return sky;
        const float error = std::abs(distance - wanted) * std::max(cosine, grazing);
        return 0.5f * std::log2(1 + error / usual);
    }
};

/// Boxes that are moved, face by face, to where rays end as they do in the scene. Each ray knows its nearest two
/// boxes, so that what it would meet with another in the place of one is known by a single test.
class FitBoxes {
public:
    /// The rays are in the world, as are the axes of `frames`. `ends`: where rays end even without boxes, metres, 0 for
    /// those that begin inside something; empty: nowhere.
    FitBoxes(const Context& context, std::span<const FitRay> rays, std::span<const float> ends,
             std::span<const glm::mat3> frames, const FitCost& cost);

    std::span<const FitBox> boxes() const noexcept { return m_boxes; }
    /// Replaces all boxes; `step`: by how much their faces are moved at first, metres.
    void set(std::vector<FitBox> boxes, float step);
    /// Moves the faces of every box once around. Returns the cost by ray thereafter.
    double sweep();
    /// Mean cost of a ray.
    double cost() const;
    /// What each box saves: the rise of the mean cost if it were taken away.
    std::vector<double> worth() const;
    /// What a new box would save.
    double saves(const FitBox& box) const;
    void replace(std::size_t number, const FitBox& box, float step);
    void append(const FitBox& box, float step);
    /// The last box takes its number.
    void remove(std::size_t number);

    /// Where the ray ends among the boxes, kFitSky: nowhere; 0: it begins inside one.
    float distance(std::size_t ray) const noexcept { return m_distance[0][ray]; }
    /// The box that it meets there; -1: none.
    int box(std::size_t ray) const noexcept { return m_box[0][ray]; }

private:
    /// Rays in one frame, one list a component, so that loops over them use all lanes of the processor.
    struct FrameRays {
        std::array<std::vector<float>, 3> origin;
        std::array<std::vector<float>, 3> inverse;  ///< of the direction
    };
    /// A ray that a box could meet.
    struct Touched {
        glm::vec3 origin;
        float wanted;
        glm::vec3 inverse;
        float cosine;
        float others;  ///< where it ends without the box
        std::uint32_t number;
    };
    using Steps = std::array<float, 6>;

    static float meets(glm::vec3 origin, glm::vec3 inverse, const FitBox& box) noexcept;
    float meets(std::size_t ray, const FitBox& box) const noexcept;
    /// Of the rays from `begin` on, one a place of `out`.
    void meetAll(std::size_t begin, const FitBox& box, std::span<float> out) const noexcept;
    float costOf(std::size_t ray, float distance) const noexcept {
        return m_cost(m_wanted[ray], m_cosine[ray], distance);
    }
    std::size_t rays() const noexcept { return m_wanted.size(); }
    /// Calls each(ray, distance) for the rays that meet a box.
    template <class Each>
    void forBlocks(const FitBox& box, const Each& each) const;
    void findNearest(std::size_t ray);
    void findAllNearest();
    std::vector<Touched> touchedBy(std::size_t number, const FitBox& reach) const;
    double costOf(std::span<const Touched> rays, const FitBox& box) const noexcept;
    bool moveFace(std::span<const Touched> rays, const FitBox& reach, int side, float step, FitBox& box,
                  double& best) const;
    FitBox improved(std::size_t number, Steps& steps) const;
    void commit(std::size_t number, const FitBox& box);

    Context m_context;
    FitCost m_cost;
    std::vector<FrameRays> m_frames;
    std::vector<float> m_ends;  ///< empty, or kFitSky for rays that end nowhere
    std::vector<float> m_wanted;
    std::vector<float> m_cosine;
    // Of each ray the two nearest boxes that it meets; kFitSky and -1: there is none. -1 with a distance:
    // m_ends.
    std::array<std::vector<float>, 2> m_distance;
    std::array<std::vector<std::int32_t>, 2> m_box;
    std::vector<FitBox> m_boxes;
    std::vector<Steps> m_steps;
    float m_leastStep = 0;
    float m_thick = 0;
};

}  // namespace probegi
