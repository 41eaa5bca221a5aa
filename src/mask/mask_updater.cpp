#include "probegi/mask_updater.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <new>
#include <set>

#include "core/parallel.h"
#include "core/sentence.h"
#include "field/layout.h"
#include "mask/mask_bake.h"
#include "mask/moving_sight.h"

namespace probegi {

namespace {

/// Cells that a thread does between two looks at the clock.
constexpr std::size_t kCellsAtOnce = 2;

/// Of annealing a few probes, in one step between two looks at the clock.
constexpr int kMostSweeps = 200;

Result<void> checkBoxes(std::span<const OrientedBox> boxes) {
    const auto finite = [](glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    for (const OrientedBox& box : boxes)
        if (!finite(box.centre) || !finite(box.halfAxes[0]) || !finite(box.halfAxes[1]) || !finite(box.halfAxes[2]))
            return fail(ErrorCode::invalidArgument, "a moving box is not finite");
    return {};
}

bool same(const OrientedBox& a, const OrientedBox& b) {
    return a.centre == b.centre && std::equal(a.halfAxes, a.halfAxes + 3, b.halfAxes);
}

/// What is left of a budget.
class Allowance {
public:
    explicit Allowance(const MaskBudget& budget)
        : m_cells(budget.cells > 0 ? std::size_t(budget.cells) : ~std::size_t(0)),
          m_end(budget.milliseconds > 0
                    ? Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                         std::chrono::duration<double, std::milli>(std::min(budget.milliseconds, 1e6)))
                    : Clock::time_point::max()) {}

    std::size_t cells() const { return m_cells; }
    void spend(std::size_t cells) { m_cells -= cells; }
    bool over() const { return m_cells == 0 || (m_end != Clock::time_point::max() && Clock::now() >= m_end); }

private:
    using Clock = std::chrono::steady_clock;
    std::size_t m_cells;
    Clock::time_point m_end;
};

/// A cell that moving boxes came near to, and where each of them was when the cell was last looked at.
using Places = std::map<std::size_t, OrientedBox>;
struct ChangedCell {
    std::size_t cell;
    Places were;
};

/// Work on a list of cells that goes on from call to call.
template <class Item>
struct Stage {
    std::vector<Item> items{};
    std::size_t done = 0;

    bool finished() const { return done == items.size(); }
    void begin(std::vector<Item> list) { items = std::move(list), done = 0; }
    std::span<const Item> next(std::size_t most) const {
        return std::span(items).subspan(done, std::min(most, items.size() - done));
    }
};

}  // namespace

struct MaskUpdater::Impl {
    Impl(const Context& c, MaskBake&& b, std::span<const OrientedBox> moving)
        : context(c),
          bake(std::move(b)),
          firstGraph(*bake.graph),
          firstClusters(bake.clusters),
          weights(texelWeights(bake.desc.factor)),
          boxes(moving.begin(), moving.end()),
          shown(bake.publish()) {
        FieldDesc field;
        field.volumes = bake.volumes;
        volumes = makeVolumes(field);
        for (std::size_t i = 0; i < volumes.size(); ++i)
            offsets.push_back(farthestOffset(bake.volumes[i], volumes[i], probesOf(volumes[i])));
    }

    std::span<const glm::vec3> probesOf(const kernels::Volume& v) const {
        return std::span(bake.cells.probes).subspan(std::size_t(v.firstSlot), std::size_t(kernels::volumeProbes(v)));
    }
    std::size_t cellTexels() const { return weights.size(); }
    std::span<std::uint8_t> seenOf(std::size_t cell) {
        return std::span(bake.sight.seen).subspan(cell * cellTexels(), cellTexels());
    }

    std::size_t cellAt(std::size_t volume, glm::ivec3 base);
    void noteMove(std::size_t box, const OrientedBox& to);
    Result<void> work(const Tracer& tracer, Allowance& allowance, MaskUpdate& done);
    void beginCycle();
    Result<void> see(const Tracer& tracer, std::span<const ChangedCell> cells, MaskUpdate& done);
    void colour(MaskUpdate& done);
    Result<void> solve(const Tracer& tracer, std::span<const std::size_t> cells, MaskUpdate& done);
    bool settled() const { return !inCycle && changed.empty(); }

    Context context;
    MaskBake bake;           // the masks to come
    ProbeGraph firstGraph;   // of the first masks
    Clusters firstClusters;  // likewise
    std::vector<std::array<float, 8>> weights;
    std::vector<kernels::Volume> volumes;
    std::vector<glm::vec3> offsets;         // by volume: how far probes stand off their places
    std::vector<OrientedBox> boxes;         // where they are
    std::map<std::size_t, Places> changed;  // by cell: for the next cycle
    std::set<std::size_t> met;              // slots of probes of cells that a box ever came near to
    bool inCycle = false, coloured = false;
    Stage<ChangedCell> seeing;
    Stage<std::size_t> solving;
    std::shared_ptr<const Masks> shown;
};

/// A cell that nothing had come near to before is new: all is seen in it.
std::size_t MaskUpdater::Impl::cellAt(std::size_t volume, glm::ivec3 base) {
    const kernels::Volume& v = volumes[volume];
    const int slot = v.firstSlot + base.x + v.counts.x * (base.y + v.counts.y * base.z);
    if (const int known = bake.graph->cellWith(bake.cells, std::size_t(slot), 0); known >= 0) return std::size_t(known);
    const std::size_t cell = bake.cells.blocked.size();
    bake.cells.blocked.push_back(
        makeMaskCell(bake.volumes[volume], v.firstSlot, base, bake.desc.factor, bake.cells.probes));
    bake.sight.seen.resize((cell + 1) * cellTexels(), 255);
    bake.cubeOf.push_back(bake.cubes.add(std::vector<std::uint32_t>(cellTexels(), kOpenTexel)));
    bake.graph->update(bake.cells, bake.sight, std::span(&cell, 1));
    return cell;
}

void MaskUpdater::Impl::noteMove(std::size_t box, const OrientedBox& to) {
    const OrientedBox from = boxes[box];
    for (std::size_t volume = 0; volume < volumes.size(); ++volume)
        for (const OrientedBox& place : {from, to}) {
            const CellRange range = cellsTouched(volumes[volume], offsets[volume], boundsOf(place));
            for (int z = range.begin.z; z < range.end.z; ++z)
                for (int y = range.begin.y; y < range.end.y; ++y)
                    for (int x = range.begin.x; x < range.end.x; ++x) {
                        const std::size_t cell = cellAt(volume, {x, y, z});
                        changed[cell].try_emplace(box, from);
                        for (const int slot : bake.cells.blocked[cell].slot) met.insert(std::size_t(slot));
                    }
        }
    boxes[box] = to;
}

void MaskUpdater::Impl::beginCycle() {
    std::vector<ChangedCell> cells;
    for (auto& [cell, were] : changed) cells.push_back({cell, std::move(were)});
    changed.clear();
    seeing.begin(std::move(cells));
    inCycle = true;
    coloured = false;
}

Result<void> MaskUpdater::Impl::see(const Tracer& tracer, std::span<const ChangedCell> cells, MaskUpdate& done) {
    std::vector<CellSight> sights(cells.size());
    auto traced = tryParallelFor(context, cells.size(), 1, [&](std::size_t begin, std::size_t) -> Result<void> {
        std::vector<OrientedBox> places;
        for (const auto& [box, was] : cells[begin].were) {
            places.push_back(was);
            places.push_back(boxes[box]);
        }
        const std::size_t cell = cells[begin].cell;
        auto sight = seeCellAgain(tracer, bake.cells.blocked[cell], bake.desc.factor, places, seenOf(cell));
        if (!sight) return sight.error();
        sights[begin] = std::move(*sight);
        return {};
    });
    if (!traced) return traced;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        std::ranges::copy(sights[i].seen, seenOf(cells[i].cell).begin());
        for (const LinkSight& link : sights[i].links) setLink(bake.sight.links, link);
        done.rays += sights[i].rays;
    }
    done.seenCells += cells.size();
    return {};
}

void MaskUpdater::Impl::colour(MaskUpdate& done) {
    std::set<std::size_t> toSolve;
    std::vector<std::size_t> seen;
    for (const ChangedCell& cell : seeing.items) seen.push_back(cell.cell);
    toSolve.insert(seen.begin(), seen.end());
    bake.graph->update(bake.cells, bake.sight, seen);
    if (bake.desc.clusters < 8) {      // otherwise each probe has its own
        std::set<std::size_t> parted;  // and those around them, which may make room
        for (const std::size_t slot : met) {
            if (bake.graph->sameAround(firstGraph, slot)) continue;
            parted.insert(slot);
            bake.graph->forNeighbours(slot, [&](std::size_t other, float) { parted.insert(other); });
        }
        const std::vector<std::size_t> again(parted.begin(), parted.end());
        Clusters clusters = firstClusters;
        const MaskDesc& d = bake.desc;
        recolour(*bake.graph, again, {d.clusters, std::min(d.sweeps, kMostSweeps), d.sparsity, d.seed}, clusters);
        for (std::size_t slot = 0; slot < clusters.size(); ++slot) {
            if (clusters[slot] == bake.clusters[slot]) continue;
            ++done.recoloured;
            for (std::size_t corner = 0; corner < 8; ++corner)
                if (const int cell = bake.graph->cellWith(bake.cells, slot, corner); cell >= 0)
                    toSolve.insert(std::size_t(cell));
        }
        bake.clusters = std::move(clusters);
    }
    solving.begin({toSolve.begin(), toSolve.end()});
    coloured = true;
}

Result<void> MaskUpdater::Impl::solve(const Tracer& tracer, std::span<const std::size_t> cells, MaskUpdate& done) {
    std::vector<std::uint32_t> texels(cells.size() * cellTexels());
    std::vector<MaskSums> sums(cells.size());
    auto solved = tryParallelFor(context, cells.size(), 1, [&](std::size_t begin, std::size_t) -> Result<void> {
        const auto cell = solveCell(tracer, bake.cells.blocked[cells[begin]], seenOf(cells[begin]), bake.clusters,
                                    {bake.desc.factor, bake.desc.strict}, weights,
                                    std::span(texels).subspan(begin * cellTexels(), cellTexels()));
        if (!cell) return cell.error();
        sums[begin] = *cell;
        return {};
    });
    if (!solved) return solved;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        std::uint32_t& cube = bake.cubeOf[cells[i]];
        const std::uint32_t before = cube;
        cube = bake.cubes.add(std::span(texels).subspan(i * cellTexels(), cellTexels()));
        bake.cubes.release(before);
        done.rays += sums[i].rays;
    }
    done.solvedCells += cells.size();
    return {};
}

Result<void> MaskUpdater::Impl::work(const Tracer& tracer, Allowance& allowance, MaskUpdate& done) {
    const std::size_t batch = kCellsAtOnce * std::size_t(context.threads());
    while (!settled()) {
        if (!inCycle) beginCycle();
        const std::size_t most = std::min(batch, allowance.cells());
        std::size_t cells = 0;
        if (!seeing.finished()) {
            const auto next = seeing.next(most);
            cells = next.size();
            if (auto traced = see(tracer, next, done); !traced) return traced;
            seeing.done += cells;
        } else if (!coloured) {
            colour(done);
        } else if (!solving.finished()) {
            const auto next = solving.next(most);
            cells = next.size();
            if (auto solved = solve(tracer, next, done); !solved) return solved;
            solving.done += cells;
        } else {
            shown = bake.publish();
            done.published = true;
            inCycle = false;
            continue;
        }
        allowance.spend(cells);
        if (allowance.over()) break;
    }
    return {};
}

MaskUpdater::MaskUpdater(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
MaskUpdater::MaskUpdater(MaskUpdater&&) noexcept = default;
MaskUpdater& MaskUpdater::operator=(MaskUpdater&&) noexcept = default;
MaskUpdater::~MaskUpdater() = default;

Result<MaskUpdater> MaskUpdater::create(const Context& context, const Tracer& tracer, const FieldDesc& field,
                                        const MaskDesc& desc, std::span<const OrientedBox> boxes) try {
    if (auto ok = checkBoxes(boxes); !ok) return ok.error();
    auto bake = bakeMaskParts(context, tracer, field, desc);
    if (!bake) return bake.error();
    return MaskUpdater(std::make_unique<Impl>(context, std::move(*bake), boxes));
} catch (const std::bad_alloc&) {
    return noMemoryForMasks();
}

Result<void> MaskUpdater::move(std::span<const OrientedBox> boxes) try {
    if (boxes.size() != m_impl->boxes.size())
        return fail(ErrorCode::invalidArgument,
                    sentence("there are ", boxes.size(), " moving boxes; at first there were ", m_impl->boxes.size()));
    if (auto ok = checkBoxes(boxes); !ok) return ok;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (!same(boxes[i], m_impl->boxes[i])) m_impl->noteMove(i, boxes[i]);
    return {};
} catch (const std::bad_alloc&) {
    return noMemoryForMasks();
}

Result<MaskUpdate> MaskUpdater::update(const Tracer& tracer, const MaskBudget& budget) try {
    if (!(budget.milliseconds >= 0) || budget.cells < 0)
        return fail(ErrorCode::invalidArgument, "a mask budget is negative");
    MaskUpdate done;
    Allowance allowance(budget);
    if (auto worked = m_impl->work(tracer, allowance, done); !worked) return worked.error();
    done.settled = m_impl->settled();
    return done;
} catch (const std::bad_alloc&) {
    return noMemoryForMasks();
}

bool MaskUpdater::settled() const noexcept {
    return m_impl->settled();
}
const std::shared_ptr<const Masks>& MaskUpdater::masks() const noexcept {
    return m_impl->shown;
}

}  // namespace probegi
