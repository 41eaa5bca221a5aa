#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "field_file/byte_stream.h"
#include "io/budget.h"

namespace probegi {

/// Four letters.
using ChunkName = std::array<char, 4>;
constexpr ChunkName chunkName(const char (&text)[5]) {
    return {text[0], text[1], text[2], text[3]};
}

/// Whether a reader that does not know a chunk may pass it over.
enum class ChunkNeed : std::uint8_t { optional, required };

/// With which a field's file begins.
bool beginsAsFieldFile(std::span<const std::uint8_t> bytes) noexcept;
inline constexpr std::size_t kMagicBytes = 8;
/// Of the header.
inline constexpr std::size_t kHeaderBytes = 32;

/// Checks the header of a file of so many bytes; `begin` has all of it, or the file has no more. Returns the number of
/// chunks. Throws io::Refused.
std::uint32_t readHeader(std::span<const std::uint8_t> begin, std::uint64_t fileBytes);
inline void checkHeader(std::span<const std::uint8_t> begin, std::uint64_t fileBytes) {
    readHeader(begin, fileBytes);
}

/// Makes a file of chunks, compressed one by one.
class ChunkWriter {
public:
    ChunkWriter();
    /// Throws io::Refused, std::bad_alloc.
    void add(ChunkName name, ChunkNeed need, std::span<const std::byte> content);
    /// An array of numbers.
    template <class T>
    void addArray(ChunkName name, ChunkNeed need, std::span<const T> values) {
        if constexpr (std::endian::native == std::endian::little) {
            add(name, need, std::as_bytes(values));
        } else {
            ByteWriter bytes;
            for (const T value : values) bytes.put(value);
            add(name, need, bytes.bytes());
        }
    }
    std::vector<std::uint8_t> finish() &&;

private:
    std::vector<std::uint8_t> m_file;
    std::uint32_t m_chunks = 0;
};

/// A file of chunks: which there are is known, and nothing is unpacked yet. Everything throws io::Refused.
class ChunkReader {
public:
    /// The bytes must outlive it. Checks headers and hashes, and that each chunk is one of `known` or optional.
    ChunkReader(std::span<const std::uint8_t> file, std::span<const ChunkName> known, io::Budget& budget);

    bool has(ChunkName name) const noexcept { return find(name) != nullptr; }
    /// The content of a chunk, which must be there.
    std::vector<std::byte> content(ChunkName name) const;
    /// The same as `count` numbers, which it must be.
    template <class T>
    std::vector<T> array(ChunkName name, std::uint64_t count) const {
        static_assert(std::is_arithmetic_v<T>);
        std::vector<T> values(sizeFor(name, count, sizeof(T)));
        unpack(name, std::as_writable_bytes(std::span(values)));
        if constexpr (std::endian::native != std::endian::little)
            for (T& value : values) value = littleEndian(value);
        return values;
    }
    /// Numbers of so many bytes in a chunk, which must be there.
    std::uint64_t arrayLength(ChunkName name, std::size_t bytesEach) const;

private:
    struct Chunk {
        ChunkName name;
        bool required, packed;
        std::uint64_t unpackedBytes;
        std::span<const std::uint8_t> stored;
    };
    const Chunk* find(ChunkName name) const noexcept;
    const Chunk& get(ChunkName name) const;
    /// Checked against the chunk's length, and charged.
    std::size_t sizeFor(ChunkName name, std::uint64_t count, std::size_t bytesEach) const;
    void unpack(ChunkName name, std::span<std::byte> out) const;
    Chunk readChunk(std::span<const std::uint8_t> file, std::uint64_t& at) const;

    std::vector<Chunk> m_chunks;
    io::Budget& m_budget;
};

}  // namespace probegi
