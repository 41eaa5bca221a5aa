#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "field_file/byte_stream.h"
#include "field_file/content_hash.h"

namespace probegi::test {

using FileBytes = std::vector<std::uint8_t>;

/// A chunk as it is in a file, taken apart and put together by docs/field_file.md alone.
struct RawChunk {
    std::string name;
    std::uint32_t flags = 0;
    std::uint64_t unpackedBytes = 0;
    FileBytes stored;
};

struct RawFile {
    std::uint32_t version = 1;
    std::vector<RawChunk> chunks;

    RawChunk& chunk(const std::string& name) {
        for (RawChunk& c : chunks)
            if (c.name == name) return c;
        throw std::runtime_error("no chunk " + name);
    }
};

inline std::uint64_t numberAt(const FileBytes& bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value |= std::uint64_t(bytes.at(at + i)) << (8 * i);
    return value;
}

inline RawFile takenApart(const FileBytes& file) {
    RawFile raw{std::uint32_t(numberAt(file, 8, 4)), {}};
    std::size_t at = 32;
    for (std::uint64_t i = 0; i < numberAt(file, 12, 4); ++i) {
        RawChunk chunk{std::string(file.begin() + std::ptrdiff_t(at), file.begin() + std::ptrdiff_t(at) + 4),
                       std::uint32_t(numberAt(file, at + 4, 4)),
                       numberAt(file, at + 8, 8),
                       {}};
        const std::size_t begin = at + 40, size = numberAt(file, at + 16, 8);
        chunk.stored.assign(file.begin() + std::ptrdiff_t(begin), file.begin() + std::ptrdiff_t(begin + size));
        raw.chunks.push_back(chunk);
        at = begin + size;
    }
    return raw;
}

/// With right lengths and checksums.
inline FileBytes putTogether(const RawFile& raw) {
    FileBytes file;
    const auto append = [&](const ByteWriter& bytes) {
        for (const std::byte byte : bytes.bytes()) file.push_back(std::uint8_t(byte));
    };
    std::uint64_t length = 32;
    for (const RawChunk& chunk : raw.chunks) length += 40 + chunk.stored.size();
    ByteWriter header;
    for (const char byte : {'\x89', 'P', 'G', 'I', 'F', '\r', '\n', '\x1a'}) header.put(byte);
    header.put(raw.version);
    header.put(std::uint32_t(raw.chunks.size()));
    header.put(length);
    header.put(hashOf(header.bytes()));
    append(header);
    for (const RawChunk& chunk : raw.chunks) {
        ByteWriter each;
        for (const char letter : chunk.name) each.put(letter);
        each.put(chunk.flags);
        each.put(chunk.unpackedBytes);
        each.put(std::uint64_t(chunk.stored.size()));
        each.put(hashOf(std::as_bytes(std::span(chunk.stored))));
        each.put(hashOf(each.bytes()));
        append(each);
        file.insert(file.end(), chunk.stored.begin(), chunk.stored.end());
    }
    return file;
}

}  // namespace probegi::test
