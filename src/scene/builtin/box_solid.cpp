#include "scene/builtin/box_solid.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/builtin/mesh_builder.h"

namespace probegi::builtin {

namespace {

float snap(float v) {
    return std::round(v * 1e4f) / 1e4f;
}
glm::vec3 snap(glm::vec3 v) {
    return {snap(v.x), snap(v.y), snap(v.z)};
}

/// The boxes' coordinates divide space into cells that are entirely solid or empty.
class Cells {
public:
    struct Cell {
        int material = -1;  ///< -1: empty
        int step = -1;      ///< the last one that touched it
    };

    void addCuts(glm::vec3 p) {
        for (int axis = 0; axis < 3; ++axis) m_cuts[axis].push_back(p[axis]);
    }

    void allocate() {
        std::size_t count = 1;
        for (auto& cuts : m_cuts) {
            std::sort(cuts.begin(), cuts.end());
            cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
            count *= cuts.size() - 1;
        }
        m_cells.resize(count);
    }

    int size(int axis) const { return int(m_cuts[axis].size()) - 1; }
    float cut(int axis, int index) const { return m_cuts[axis][std::size_t(index)]; }

    int find(int axis, float coordinate) const {
        const auto& cuts = m_cuts[axis];
        return int(std::lower_bound(cuts.begin(), cuts.end(), coordinate) - cuts.begin());
    }

    Cell& at(glm::ivec3 c) { return m_cells[std::size_t(c.x + size(0) * (c.y + size(1) * c.z))]; }

    /// Everything outside is empty.
    Cell get(glm::ivec3 c) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (c[axis] < 0 || c[axis] >= size(axis)) return {};
        }
        return const_cast<Cells*>(this)->at(c);
    }

    glm::vec3 corner(glm::ivec3 c) const { return {cut(0, c.x), cut(1, c.y), cut(2, c.z)}; }

    template <class Visit>
    void forEach(glm::ivec3 from, glm::ivec3 to, const Visit& visit) const {
        for (int z = from.z; z < to.z; ++z) {
            for (int y = from.y; y < to.y; ++y) {
                for (int x = from.x; x < to.x; ++x) visit(glm::ivec3(x, y, z));
            }
        }
    }

private:
    std::array<std::vector<float>, 3> m_cuts;
    std::vector<Cell> m_cells;
};

void emitFace(MeshBuilder& out, const Cells& cells, glm::ivec3 c, int axis, bool positive) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    glm::ivec3 a = c;
    if (positive) ++a[axis];
    glm::ivec3 b = a, d = a;
    ++b[u];
    ++d[v];
    glm::ivec3 e = b;
    ++e[v];
    if (!positive) std::swap(b, d);
    out.quad(cells.corner(a), cells.corner(b), cells.corner(e), cells.corner(d));
}

}  // namespace

void BoxSolid::fill(glm::vec3 lower, glm::vec3 upper, int material) {
    m_steps.push_back({snap(lower), snap(upper), material, {}});
}

void BoxSolid::carve(glm::vec3 lower, glm::vec3 upper, const Paint& paint) {
    m_steps.push_back({snap(lower), snap(upper), -1, paint});
}

Mesh BoxSolid::build(std::string name) const {
    Cells cells;
    for (const Step& step : m_steps) {
        cells.addCuts(step.lower);
        cells.addCuts(step.upper);
    }
    cells.allocate();
    for (std::size_t s = 0; s < m_steps.size(); ++s) {
        const Step& step = m_steps[s];
        glm::ivec3 from, to;
        for (int axis = 0; axis < 3; ++axis) {
            from[axis] = cells.find(axis, step.lower[axis]);
            to[axis] = cells.find(axis, step.upper[axis]);
        }
        cells.forEach(from, to, [&](glm::ivec3 c) { cells.at(c) = {step.material, int(s)}; });
    }

    std::map<int, MeshBuilder> builders;
    const glm::ivec3 all(cells.size(0), cells.size(1), cells.size(2));
    cells.forEach(glm::ivec3(0), all, [&](glm::ivec3 c) {
        const Cells::Cell cell = cells.get(c);
        if (cell.material < 0) return;
        for (int side = 0; side < 6; ++side) {
            glm::ivec3 n = c;
            n[side / 2] += side % 2 == 0 ? 1 : -1;
            const Cells::Cell neighbour = cells.get(n);
            if (neighbour.material >= 0) continue;
            int material = cell.material;
            // The space's paint, unless the wall was added later.
            if (neighbour.step > cell.step) {
                const int painted = m_steps[std::size_t(neighbour.step)].paint.byNormal[std::size_t(side)];
                if (painted >= 0) material = painted;
            }
            emitFace(builders.try_emplace(material, material).first->second, cells, c, side / 2, side % 2 == 0);
        }
    });
    Mesh mesh;
    mesh.name = std::move(name);
    for (auto& [material, builder] : builders) mesh.primitives.push_back(builder.take());
    return mesh;
}

}  // namespace probegi::builtin
