#include "field_file/chunk_file.h"

#include <zstd.h>

#include <algorithm>

#include "field_file/content_hash.h"

namespace probegi {

namespace {

using io::refuse;
using io::refuseMalformed;

/// As in PNG: not text, and changed by whoever takes it for text.
constexpr std::array<std::uint8_t, kMagicBytes> kMagic{0x89, 'P', 'G', 'I', 'F', '\r', '\n', 0x1a};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderHashed = 24;
constexpr std::size_t kChunkHeaderBytes = 40, kChunkHashed = 32;
constexpr std::uint32_t kRequired = 1, kPacked = 2, kKnownFlags = kRequired | kPacked;
constexpr int kLevel = 3;

std::span<const std::byte> bytesOf(std::span<const std::uint8_t> bytes) {
    return std::as_bytes(bytes);
}

std::string shown(ChunkName name) {
    std::string text(name.data(), name.size());
    for (char& c : text)
        if (c < 'A' || c > 'Z') c = '?';
    return text;
}

/// zstd's bytes, or none where they would be no fewer.
std::size_t packInto(std::span<std::uint8_t> room, std::span<const std::byte> content) {
    const std::size_t size = ZSTD_compress(room.data(), room.size(), content.data(), content.size(), kLevel);
    if (ZSTD_isError(size)) refuse(ErrorCode::outOfMemory, "cannot be compressed ({})", ZSTD_getErrorName(size));
    return size < content.size() ? size : 0;
}

}  // namespace

bool beginsAsFieldFile(std::span<const std::uint8_t> bytes) noexcept {
    return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

ChunkWriter::ChunkWriter() : m_file(kHeaderBytes) {}

void ChunkWriter::add(ChunkName name, ChunkNeed need, std::span<const std::byte> content) {
    const std::size_t at = m_file.size(), begin = at + kChunkHeaderBytes;
    m_file.resize(begin + ZSTD_compressBound(content.size()));
    const std::size_t packed = packInto(std::span(m_file).subspan(begin), content);
    const std::size_t stored = packed > 0 ? packed : content.size();
    m_file.resize(begin + stored);
    if (packed == 0)
        std::copy(content.begin(), content.end(),
                  std::as_writable_bytes(std::span(m_file)).begin() + std::ptrdiff_t(begin));

    ByteWriter header;
    for (const char letter : name) header.put(std::uint8_t(letter));
    header.put((need == ChunkNeed::required ? kRequired : 0u) | (packed > 0 ? kPacked : 0u));
    header.put(std::uint64_t(content.size()));
    header.put(std::uint64_t(stored));
    header.put(hashOf(bytesOf(std::span(m_file).subspan(begin))));
    header.put(hashOf(header.bytes()));
    std::memcpy(m_file.data() + at, header.bytes().data(), kChunkHeaderBytes);
    ++m_chunks;
}

std::vector<std::uint8_t> ChunkWriter::finish() && {
    ByteWriter header;
    for (const std::uint8_t byte : kMagic) header.put(byte);
    header.put(kVersion);
    header.put(m_chunks);
    header.put(std::uint64_t(m_file.size()));
    header.put(hashOf(header.bytes()));
    std::memcpy(m_file.data(), header.bytes().data(), kHeaderBytes);
    return std::move(m_file);
}

std::uint32_t readHeader(std::span<const std::uint8_t> file, std::uint64_t fileBytes) {
    if (!beginsAsFieldFile(file))
        refuseMalformed("is not a field of ProbeGI; give a file that 'probegi bake' or saveField() has written");
    if (file.size() < kHeaderBytes) refuseMalformed("is cut off in its header; copy or bake it again");
    ByteReader header(bytesOf(file.subspan(kMagic.size(), kHeaderBytes - kMagic.size())), "header");
    const auto version = header.take<std::uint32_t>();
    const auto chunks = header.take<std::uint32_t>();
    const auto length = header.take<std::uint64_t>();
    if (header.take<std::uint64_t>() != hashOf(bytesOf(file.first(kHeaderHashed))))
        refuseMalformed("is damaged: its header does not have its checksum; copy or bake it again");
    // The header stays in later versions, which tell so.
    if (version != kVersion)
        refuse(ErrorCode::unsupported, "is of version {} of its format; this ProbeGI reads version {}; use a later one",
               version, kVersion);
    if (length != fileBytes)
        refuseMalformed("is cut off or damaged: it has {} bytes and should have {}; copy or bake it again", fileBytes,
                        length);
    return chunks;
}

ChunkReader::ChunkReader(std::span<const std::uint8_t> file, std::span<const ChunkName> known, io::Budget& budget)
    : m_budget(budget) {
    const std::uint32_t chunks = readHeader(file, file.size());
    std::uint64_t at = kHeaderBytes;
    for (std::uint32_t i = 0; i < chunks; ++i) {
        const Chunk chunk = readChunk(file, at);
        if (std::find(known.begin(), known.end(), chunk.name) == known.end()) {
            if (chunk.required)
                refuse(ErrorCode::unsupported,
                       "has a part {} that this ProbeGI does not know and must not skip; use the version that wrote it",
                       shown(chunk.name));
            continue;
        }
        if (has(chunk.name)) refuseMalformed("is damaged: it has its part {} twice", shown(chunk.name));
        m_chunks.push_back(chunk);
    }
    if (at != file.size()) refuseMalformed("is damaged: {} bytes belong to none of its parts", file.size() - at);
}

ChunkReader::Chunk ChunkReader::readChunk(std::span<const std::uint8_t> file, std::uint64_t& at) const {
    if (file.size() - at < kChunkHeaderBytes) refuseMalformed("is damaged: it has fewer parts than it says");
    const auto bytes = file.subspan(std::size_t(at), kChunkHeaderBytes);
    ByteReader header(bytesOf(bytes), "parts");
    Chunk chunk{};
    for (char& letter : chunk.name) letter = char(header.take<std::uint8_t>());
    const auto flags = header.take<std::uint32_t>();
    chunk.packed = (flags & kPacked) != 0;
    chunk.required = (flags & kRequired) != 0;
    chunk.unpackedBytes = header.take<std::uint64_t>();
    const auto stored = header.take<std::uint64_t>(), hash = header.take<std::uint64_t>();
    if (header.take<std::uint64_t>() != hashOf(bytesOf(bytes.first(kChunkHashed))))
        refuseMalformed("is damaged: the header of a part does not have its checksum; copy or bake it again");
    if ((flags & ~kKnownFlags) != 0)
        refuse(ErrorCode::unsupported,
               "has a part {} that is stored in a way that this ProbeGI does not know; use the version that wrote it",
               shown(chunk.name));
    at += kChunkHeaderBytes;
    if (stored > file.size() - at) refuseMalformed("is damaged: its part {} reaches beyond its end", shown(chunk.name));
    chunk.stored = file.subspan(std::size_t(at), std::size_t(stored));
    at += stored;
    if (hash != hashOf(bytesOf(chunk.stored)))
        refuseMalformed("is damaged: its part {} does not have its checksum; copy or bake it again", shown(chunk.name));
    if (!chunk.packed && chunk.unpackedBytes != stored)
        refuseMalformed("is damaged: its part {} says that it has two lengths", shown(chunk.name));
    return chunk;
}

const ChunkReader::Chunk* ChunkReader::find(ChunkName name) const noexcept {
    for (const Chunk& chunk : m_chunks)
        if (chunk.name == name) return &chunk;
    return nullptr;
}

const ChunkReader::Chunk& ChunkReader::get(ChunkName name) const {
    if (const Chunk* chunk = find(name)) return *chunk;
    refuseMalformed("is damaged: it lacks its part {}", shown(name));
}

std::uint64_t ChunkReader::arrayLength(ChunkName name, std::size_t bytesEach) const {
    return get(name).unpackedBytes / bytesEach;
}

std::size_t ChunkReader::sizeFor(ChunkName name, std::uint64_t count, std::size_t bytesEach) const {
    const Chunk& chunk = get(name);
    if (chunk.unpackedBytes % bytesEach != 0 || chunk.unpackedBytes / bytesEach != count)
        refuseMalformed("is damaged: its part {} has {} bytes, and should have {} times {}", shown(name),
                        chunk.unpackedBytes, count, bytesEach);
    m_budget.charge(chunk.unpackedBytes);
    if (chunk.unpackedBytes > std::uint64_t(PTRDIFF_MAX))
        refuse(ErrorCode::outOfMemory, "has a part of {} bytes, more than this program can hold", chunk.unpackedBytes);
    return std::size_t(count);
}

std::vector<std::byte> ChunkReader::content(ChunkName name) const {
    std::vector<std::byte> bytes(sizeFor(name, get(name).unpackedBytes, 1));
    unpack(name, bytes);
    return bytes;
}

void ChunkReader::unpack(ChunkName name, std::span<std::byte> out) const {
    const Chunk& chunk = get(name);
    if (!chunk.packed) {
        std::copy_n(std::as_bytes(chunk.stored).begin(), out.size(), out.begin());
        return;
    }
    const std::size_t size = ZSTD_decompress(out.data(), out.size(), chunk.stored.data(), chunk.stored.size());
    if (ZSTD_isError(size) || size != out.size())
        refuseMalformed("is damaged: its part {} cannot be unpacked; copy or bake it again", shown(name));
}

}  // namespace probegi
