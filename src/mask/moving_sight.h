#pragma once

#include "mask/probe_sight.h"
#include "probegi/mask_updater.h"

namespace probegi {

/// World coordinates to those of a box, in which it reaches from -1 to 1.
class BoxFrame {
public:
    /// `margin`: metres by which the box is made larger.
    BoxFrame(const OrientedBox& box, float margin);

    glm::vec3 direction(glm::vec3 world) const;
    glm::vec3 point(glm::vec3 world) const { return direction(world - m_centre); }

private:
    glm::vec3 m_centre;
    glm::vec3 m_rows[3];
};

/// Whether a segment meets the box from -1 to 1, ends included.
bool meetsBox(glm::vec3 from, glm::vec3 to);

/// World bounds of a box.
Bounds boundsOf(const OrientedBox& box);

/// Whether the probes of two slots, the second the next one along an axis, see each other.
struct LinkSight {
    std::size_t from, to;
    unsigned axis;
    bool open;
};

/// Notes it at both ends, in ProbeSight::links.
void setLink(std::span<std::uint8_t> links, const LinkSight& link);

/// What was traced again in a cell.
struct CellSight {
    std::vector<std::uint8_t> seen;  ///< all of the cell's
    std::vector<LinkSight> links{};  ///< those that were traced
    std::uint64_t rays = 0;
};

/// Traces again what boxes may have changed of a cell's sight, `seen`, and of its probes' links: the segments that meet
/// one of them. `boxes`: all places of what moved, before and now. Errors: those of the tracer.
Result<CellSight> seeCellAgain(const Tracer& tracer, const MaskCell& cell, int factor,
                               std::span<const OrientedBox> boxes, std::span<const std::uint8_t> seen);

}  // namespace probegi
