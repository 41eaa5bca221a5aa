// Any bytes as a field's file: a field that is saved again as it was, or an error message, never a crash. Inputs have
// no checksums, which no fuzzer would guess: they are made right here first.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "field_file/content_hash.h"
#include "field_file/field_bytes.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint64_t numberAt(const Bytes& bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value |= std::uint64_t(bytes[at + i]) << (8 * i);
    return value;
}

/// The hash of some of the bytes, written behind them or elsewhere.
void seal(Bytes& bytes, std::size_t from, std::size_t size, std::size_t at) {
    const std::uint64_t hash = probegi::hashOf(std::as_bytes(std::span(bytes).subspan(from, size)));
    for (std::size_t i = 0; i < 8; ++i) bytes[at + i] = std::uint8_t(hash >> (8 * i));
}

/// As far as the file's own lengths lead.
void makeChecksumsRight(Bytes& file) {
    if (file.size() < 32) return;
    for (std::size_t i = 0; i < 8; ++i) file[16 + i] = std::uint8_t(std::uint64_t(file.size()) >> (8 * i));
    seal(file, 0, 24, 24);
    for (std::size_t at = 32; file.size() - at >= 40;) {
        const std::uint64_t stored = numberAt(file, at + 16, 8);
        if (stored > file.size() - at - 40) return;
        seal(file, at + 40, std::size_t(stored), at + 24);
        seal(file, at, 32, at + 32);
        at += 40 + std::size_t(stored);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace probegi;
    const ReadLimits limits{.megabytes = 16};
    Bytes file(data, data + size);
    (void)loadFieldFromMemory("field", file, limits);
    makeChecksumsRight(file);
    const auto loaded = loadFieldFromMemory("field", file, limits);
    if (!loaded) return 0;
    const Bytes again = encodeField(*loaded);
    if (!loadFieldFromMemory("again", again, limits)) std::abort();
    return 0;
}
