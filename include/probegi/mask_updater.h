#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "probegi/export.h"
#include "probegi/masks.h"

namespace probegi {

/// A box that may stand turned, in the world, metres.
struct OrientedBox {
    glm::vec3 centre{0.0f};
    glm::vec3 halfAxes[3]{};  ///< from the centre to three of its faces; at right angles, or skewed as a mesh is
};

/// The boxes of what may move, as it stands in a pose: one for each instance of a mesh that an animation moves (as
/// movingBounds(), but turned with the node), in the order of their nodes. A node that the pose leaves out, since it is
/// scaled to nothing, has a box of no size, so that all poses of a scene have as many.
PROBEGI_API std::vector<OrientedBox> movingBoxes(const Scene& scene, const ScenePose& pose);

/// How much MaskUpdater::update() may do. It does one cell at least, so that it always comes to an end.
struct MaskBudget {
    double milliseconds = 0;  ///< of time on the clock, >= 0; 0: no limit
    int cells = 0;            ///< looked at or solved, >= 0; 0: no limit
};

/// What one update did.
struct MaskUpdate {
    bool published = false;       ///< masks() are new
    bool settled = true;          ///< nothing is left to do: masks() are those of the scene as it is
    std::size_t seenCells = 0;    ///< whose visibility was traced
    std::size_t solvedCells = 0;  ///< whose masks were solved
    std::size_t recoloured = 0;   ///< probes that have another cluster than before
    std::uint64_t rays = 0;
};

/// Masks that follow moving geometry, as doors, lifts and walls (mask paper, section 6: left there to future work). Of
/// the cells that a moving box comes near to, only the rays are traced that meet it where it was or where it is; probes
/// that it parts otherwise from their neighbours than when the masks were first baked, and these neighbours, are
/// coloured again, all others keep their cluster; and only masks of cells that this changes are solved. So the masks
/// depend on where things are and not on how they got there: a door that is shut again has its first masks. What
/// look-ups read stays as it was until all of a change is done (double buffering). Move-only; not for concurrent calls.
class PROBEGI_API MaskUpdater {
public:
    /// Bakes the first masks. `boxes`: what may move, as the tracer has it now. `desc` and `boxes` are read during the
    /// call only. Errors: those of bakeMasks(), and invalidArgument (a box is not finite).
    static Result<MaskUpdater> create(const Context& context, const Tracer& tracer, const FieldDesc& field,
                                      const MaskDesc& desc, std::span<const OrientedBox> boxes);
    MaskUpdater(MaskUpdater&&) noexcept;
    MaskUpdater& operator=(MaskUpdater&&) noexcept;
    ~MaskUpdater();

    /// Where the boxes are now; the tracer of the next update must have them there. Each must hold all triangles of
    /// what it stands for. Errors: invalidArgument (not as many as at first, or one is not finite).
    [[nodiscard]] Result<void> move(std::span<const OrientedBox> boxes);
    /// Goes on with what is to be done. Errors: those of the tracer, and invalidArgument (a negative budget); what was
    /// left to do is then still left.
    Result<MaskUpdate> update(const Tracer& tracer, const MaskBudget& budget = {});
    bool settled() const noexcept;
    /// For FieldSettings::masks. Their report is that of the first bake but for cubes and bytes.
    const std::shared_ptr<const Masks>& masks() const noexcept;

private:
    struct Impl;
    explicit MaskUpdater(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

}  // namespace probegi
