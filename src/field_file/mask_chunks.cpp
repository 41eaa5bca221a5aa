#include <cmath>

#include "field/layout.h"
#include "field/masks_impl.h"
#include "field_file/field_chunks.h"

namespace probegi {

namespace {

using io::refuseMalformed;

/// Of a slot's second word, by kernels/guards/masks.h: its cluster and six links.
constexpr std::uint32_t kSlotBits = 0x3f07;
constexpr std::uint64_t kMostWords = std::uint64_t(1) << 31;

/// Without the times: one field has one file, whoever baked it and when.
void putReport(ByteWriter& bytes, const MaskReport& report) {
    const auto& [visibility, cluster, mask, compress, rays, cells, blocked, cubes, denseBytes, maskBytes, startLoss,
                 loss, residual, meanClusters, blindTexels] = report;
    (void)visibility, (void)cluster, (void)mask, (void)compress;
    for (const std::uint64_t count : {rays, std::uint64_t(cells), std::uint64_t(blocked), std::uint64_t(cubes),
                                      std::uint64_t(denseBytes), std::uint64_t(maskBytes)})
        bytes.put(count);
    for (const double value : {startLoss, loss, residual, meanClusters, blindTexels}) bytes.put(value);
}

MaskReport takeReport(ByteReader& bytes) {
    MaskReport report;
    report.rays = bytes.take<std::uint64_t>();
    for (std::size_t* count : {&report.cells, &report.blocked, &report.cubes, &report.denseBytes, &report.bytes})
        *count = std::size_t(bytes.take<std::uint64_t>());
    for (double* value : {&report.startLoss, &report.loss, &report.residual, &report.meanClusters, &report.blindTexels})
        *value = bytes.take<double>();
    return report;
}

/// Look-ups follow the words without a check: what each slot says must be there.
void checkWords(const Masks::Impl& masks, std::size_t slots) {
    const std::size_t texels = std::size_t(masks.factor) * std::size_t(masks.factor) * std::size_t(masks.factor);
    const std::size_t cubeWords = masks.clusters <= 4 ? (texels + 1) / 2 : texels;
    if (masks.words.size() < 2 * slots + cubeWords || (masks.words.size() - 2 * slots) % cubeWords != 0)
        refuseMalformed("is damaged: its masks are not a whole number of cubes");
    for (std::size_t slot = 0; slot < slots; ++slot) {
        const std::uint32_t cube = masks.words[2 * slot], word = masks.words[2 * slot + 1];
        if (cube < 2 * slots || cube > masks.words.size() - cubeWords || (cube - 2 * slots) % cubeWords != 0 ||
            (word & ~kSlotBits) != 0 || int(word & 7u) >= masks.clusters)
            refuseMalformed("is damaged: its masks of slot {} are not there", slot);
    }
}

}  // namespace

void writeMasks(ChunkWriter& file, const Masks& masks) {
    ByteWriter bytes;
    bytes.put(std::int32_t(masks.clusters()));
    bytes.put(std::int32_t(masks.factor()));
    putReport(bytes, masks.report());
    putVolumes(bytes, masks.volumes());
    file.add(kMasksChunk, ChunkNeed::required, bytes.bytes());
    file.addArray(kMaskWordsChunk, ChunkNeed::required, masks.words());
}

std::shared_ptr<const Masks> readMasks(const ChunkReader& file) {
    if (!file.has(kMasksChunk)) return nullptr;
    const std::vector<std::byte> content = file.content(kMasksChunk);
    ByteReader bytes(content, "masks");
    auto impl = std::make_unique<Masks::Impl>();
    impl->clusters = bytes.take<std::int32_t>();
    impl->factor = bytes.take<std::int32_t>();
    if (impl->clusters < 1 || impl->clusters > 8 || impl->factor < 2 || impl->factor > 16)
        refuseMalformed("is damaged: it says that its masks have {} clusters and {} texels", impl->clusters,
                        impl->factor);
    impl->report = takeReport(bytes);
    FieldDesc desc;
    desc.volumes = impl->volumes = takeVolumes(bytes);
    bytes.finish();
    if (const auto valid = validateFieldDesc(desc); !valid)
        refuseMalformed("is damaged: of its masks {}", valid.error().message);
    const std::uint64_t count = file.arrayLength(kMaskWordsChunk, sizeof(std::uint32_t));
    if (count > kMostWords) refuseMalformed("is damaged: it says that its masks have {} words", count);
    impl->words = file.array<std::uint32_t>(kMaskWordsChunk, count);
    checkWords(*impl, std::size_t(probeCount(desc)));
    return std::make_shared<const Masks>(std::move(impl));
}

}  // namespace probegi
