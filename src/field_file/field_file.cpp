#include "probegi/field_file.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <new>

#include "field/layout.h"
#include "field/snapshot.h"
#include "field_file/field_bytes.h"
#include "field_file/field_chunks.h"
#include "io/file_bytes.h"
#include "io/file_output.h"
#include "probegi/masks.h"

namespace probegi {

namespace {

constexpr std::size_t kLongestText = std::size_t(1) << 16;
/// Largest file that is read, where memory's addresses reach so far.
constexpr std::uint64_t kLargestFile = std::uint64_t(1) << 40;

void orRefuse(const Result<void>& valid) {
    if (!valid) io::refuse(valid.error().code, "{}", valid.error().message);
}

void validate(const SavedField& saved) {
    const FieldDesc& desc = saved.snapshot.desc;
    orRefuse(validateFieldDesc(desc));
    orRefuse(validateFieldSettings(saved.settings));
    // Whatever the guard: who has the masks may ask them for each of the field's slots, which they do not check.
    if (saved.settings.masks && saved.settings.masks->volumes() != desc.volumes)
        io::refuse(ErrorCode::invalidArgument, "its masks are of other volumes than its probes");
    orRefuse(validateGuard(desc, saved.settings, saved.snapshot.scrolled));
    if (saved.snapshot.slots != SlotRange{0, probeCount(desc)})
        io::refuse(ErrorCode::invalidArgument, "the snapshot has some of the field's probes only; read all of them");
    orRefuse(validateSnapshot(desc, saved.snapshot));
    for (const std::string* text : {&saved.provenance.program, &saved.provenance.scene, &saved.provenance.recipe})
        if (text->size() > kLongestText)
            io::refuse(ErrorCode::invalidArgument, "a text of its provenance has {} bytes; at most {} are kept",
                       text->size(), kLongestText);
}

SavedField decoded(std::span<const std::uint8_t> file, const ReadLimits& limits) {
    io::Budget budget(limits, file.size());
    const ChunkReader chunks(file, kFieldChunks, budget);
    SavedField saved;
    const FieldDesc desc = readDesc(chunks);
    if (const auto valid = validateFieldDesc(desc); !valid)
        io::refuseMalformed("is damaged: {}", valid.error().message);
    saved.settings = readSettings(chunks);
    saved.settings.masks = readMasks(chunks);
    saved.snapshot = readSnapshot(chunks, desc, budget);
    saved.provenance = readProvenance(chunks);
    if (chunks.has(kConvergenceChunk))
        saved.convergence.words = chunks.array<std::uint32_t>(
            kConvergenceChunk, chunks.arrayLength(kConvergenceChunk, sizeof(std::uint32_t)));
    return saved;
}

}  // namespace

std::vector<std::uint8_t> encodeField(const SavedField& saved) {
    validate(saved);
    ChunkWriter file;
    writeDesc(file, saved.snapshot.desc);
    writeSettings(file, saved.settings);
    writeProvenance(file, saved.provenance);
    if (saved.settings.masks) writeMasks(file, *saved.settings.masks);
    writeSnapshot(file, saved.snapshot);
    if (!saved.convergence.empty())
        file.addArray(kConvergenceChunk, ChunkNeed::optional, std::span<const std::uint32_t>(saved.convergence.words));
    return std::move(file).finish();
}

Result<SavedField> loadFieldFromMemory(std::string_view name, std::span<const std::uint8_t> file,
                                       const ReadLimits& limits) {
    return io::guarded(name, [&] {
        SavedField saved = decoded(file, limits);
        try {
            validate(saved);
        } catch (const io::Refused& refused) {
            io::refuseMalformed("is damaged: {}", refused.error.message);
        }
        return saved;
    });
}

Result<void> saveField(const std::filesystem::path& path, const SavedField& saved) {
    return io::guarded(path.string(), [&] { io::writeBytes(path, encodeField(saved)); });
}

Result<void> saveField(const std::filesystem::path& path, const Field& field, const FieldProvenance& provenance) {
    auto snapshot = field.read();
    if (!snapshot) return snapshot.error();
    return saveField(path, SavedField{std::move(*snapshot), field.control().settings(), provenance, {}});
}

Result<SavedField> loadField(const std::filesystem::path& path, const ReadLimits& limits) {
    constexpr std::uint64_t kAddressed = std::uint64_t(std::numeric_limits<std::ptrdiff_t>::max());
    const auto bytes = io::guarded(path.string(), [&] {
        // A file that is none, or is cut off, costs no memory.
        return io::readFile(path, std::min(kLargestFile, kAddressed), {kHeaderBytes, checkHeader});
    });
    if (!bytes) return bytes.error();
    return loadFieldFromMemory(path.string(), *bytes, limits);
}

bool isFieldFile(const std::filesystem::path& path) noexcept {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return false;  // a pipe would lose what is read
    std::FILE* file = std::fopen(path.c_str(), "rb");
    if (!file) return false;
    std::uint8_t begin[kMagicBytes];
    const std::size_t read = std::fread(begin, 1, sizeof begin, file);
    std::fclose(file);
    return beginsAsFieldFile(std::span(begin, read));
}

Result<Field> restoreField(const Backend& backend, const SavedField& saved) {
    auto field = backend.makeField(saved.snapshot.desc, saved.settings);
    if (!field) return field;
    if (auto written = field->write(saved.snapshot); !written) return written.error();
    return field;
}

}  // namespace probegi
