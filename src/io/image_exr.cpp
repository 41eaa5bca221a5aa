#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "io/budget.h"
#include "io/image_codec.h"

namespace probegi::io {

namespace {

class SpanReader final : public Imf::IStream {
public:
    explicit SpanReader(std::span<const std::uint8_t> bytes) : Imf::IStream("the picture"), m_bytes(bytes) {}

    bool read(char out[], int count) override {
        if (count < 0 || std::uint64_t(count) > m_bytes.size() - m_at) throw std::runtime_error("it ends too early");
        std::memcpy(out, m_bytes.data() + m_at, std::size_t(count));
        m_at += std::uint64_t(count);
        return m_at < m_bytes.size();
    }
    std::uint64_t tellg() override { return m_at; }
    void seekg(std::uint64_t position) override { m_at = std::min<std::uint64_t>(position, m_bytes.size()); }

private:
    std::span<const std::uint8_t> m_bytes;
    std::uint64_t m_at = 0;
};

class VectorWriter final : public Imf::OStream {
public:
    VectorWriter() : Imf::OStream("the picture") {}

    void write(const char data[], int count) override {
        bytes.resize(std::max(bytes.size(), m_at + std::size_t(count)));
        std::memcpy(bytes.data() + m_at, data, std::size_t(count));
        m_at += std::size_t(count);
    }
    std::uint64_t tellp() override { return m_at; }
    void seekp(std::uint64_t position) override { m_at = position; }

    std::vector<std::uint8_t> bytes;

private:
    std::size_t m_at = 0;
};

struct Window {
    Imath::V2i origin;
    int width = 0;
    int height = 0;
};

/// Bytes that OpenEXR unpacks at once: a block of lines, or a row of tiles.
std::uint64_t blockBytes(const Imf::Header& header, const Window& window, int channels) {
    constexpr int kMostLines = 256;  // in a block of any compression
    auto across = std::uint64_t(window.width);
    auto down = std::uint64_t(std::min(window.height, kMostLines));
    if (header.hasTileDescription()) {
        across = std::max<std::uint64_t>(across, header.tileDescription().xSize);
        down = header.tileDescription().ySize;
    }
    return across * down * std::uint64_t(channels) * sizeof(float);
}

/// The data window, after checking that nothing in the header needs more memory than the file justifies.
Window checkedWindow(const Imf::Header& header, std::size_t fileBytes, const ReadLimits& limits) {
    constexpr int kFarAway = 1 << 24;
    const Imath::Box2i& box = header.dataWindow();
    if (std::min(box.min.x, box.min.y) < -kFarAway || std::max(box.max.x, box.max.y) > kFarAway) {
        refuseMalformed("the EXR's data window ({}, {})..({}, {}) is out of range", box.min.x, box.min.y, box.max.x,
                        box.max.y);
    }
    const Window window{box.min, box.max.x - box.min.x + 1, box.max.y - box.min.y + 1};
    checkImageSize(window.width, window.height, fileBytes);
    int channels = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++channels;
    if (channels > 256) refuse(ErrorCode::unsupported, "the EXR has {} channels; at most 256 are supported", channels);
    if (header.hasTileDescription()) {
        const Imf::TileDescription& tile = header.tileDescription();
        if (tile.xSize > 8192 || tile.ySize > 8192) {
            refuse(ErrorCode::unsupported, "the EXR's tiles of {} x {} pixels are too large; save it by scan lines",
                   tile.xSize, tile.ySize);
        }
    }
    Budget(limits, fileBytes).charge(blockBytes(header, window, channels));
    return window;
}

/// Checks the header before OpenEXR allocates anything from it.
Window inspect(std::span<const std::uint8_t> bytes, const ReadLimits& limits) {
    SpanReader stream(bytes);
    std::array<std::uint8_t, 8> start{};
    stream.read(reinterpret_cast<char*>(start.data()), int(start.size()));
    const auto word = [&](int at) {
        return int(start[at] | start[at + 1] << 8 | start[at + 2] << 16 | unsigned(start[at + 3]) << 24);
    };
    if (word(0) != Imf::MAGIC) refuseMalformed("is not an OpenEXR picture");
    int version = word(4);
    if (Imf::isMultiPart(version) || Imf::isNonImage(version)) {
        refuse(ErrorCode::unsupported, "is a multi-part or deep EXR; save it as a single flat picture");
    }
    Imf::Header header;
    header.readFrom(stream, version);
    return checkedWindow(header, bytes.size(), limits);
}

/// Which channel feeds red, green and blue; null: stays 0.
std::array<const char*, 3> pickChannels(const Imf::ChannelList& channels) {
    std::array<const char*, 3> names{"R", "G", "B"};
    const bool grey = !channels.findChannel("R") && !channels.findChannel("G") && !channels.findChannel("B");
    if (grey) names.fill("Y");
    if (grey && (channels.findChannel("RY") || channels.findChannel("BY"))) {
        refuse(ErrorCode::unsupported, "stores luminance and chroma; save it as RGB");
    }
    for (const char*& name : names) {
        const Imf::Channel* channel = channels.findChannel(name);
        if (!channel && grey) {
            std::string found;
            for (auto c = channels.begin(); c != channels.end(); ++c) found += fmt::format(" {}", c.name());
            refuse(ErrorCode::unsupported, "has no R, G, B or Y channel (only:{}); save it as RGB", found);
        }
        if (!channel) {
            name = nullptr;
        } else if (channel->xSampling != 1 || channel->ySampling != 1) {
            refuse(ErrorCode::unsupported, "channel {} is subsampled; save it at full resolution", name);
        }
    }
    return names;
}

/// Sets where OpenEXR writes the channels of these names.
void setFrame(Imf::InputFile& file, HdrImage& image, const Window& window, std::span<const char* const> names) {
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < names.size(); ++c) {
        if (!names[c]) continue;
        frame.insert(names[c],
                     Imf::Slice::Make(Imf::FLOAT, &image.pixels[0][int(c)], window.origin, window.width, window.height,
                                      sizeof(glm::vec3), sizeof(glm::vec3) * std::size_t(window.width)));
    }
    file.setFrameBuffer(frame);
}

}  // namespace

HdrImage decodeExr(std::span<const std::uint8_t> bytes, const ReadLimits& limits) try {
    const Window window = inspect(bytes, limits);
    SpanReader stream(bytes);
    Imf::InputFile file(stream, 0);
    const std::array<const char*, 3> names = pickChannels(file.header().channels());
    const bool grey = names[0] && names[1] && std::strcmp(names[0], names[1]) == 0;
    HdrImage image = emptyImage(window.width, window.height, bytes.size(), limits);
    // Some lines at a time; their memory is reserved, so it does not move.
    constexpr int kLines = 256;
    for (int line = 0; line < window.height; line += kLines) {
        const int end = std::min(line + kLines, window.height);
        image.pixels.resize(std::size_t(window.width) * std::size_t(end));
        if (line == 0) setFrame(file, image, window, grey ? std::span(names).first(1) : std::span(names));
        file.readPixels(window.origin.y + line, window.origin.y + end - 1);
    }
    if (grey) {
        for (glm::vec3& pixel : image.pixels) pixel = glm::vec3(pixel.x);
    }
    return image;
} catch (const std::bad_alloc&) {
    throw;
} catch (const std::exception& e) {
    refuseMalformed("is not a readable EXR ({}); save it again", e.what());
}

std::vector<std::uint8_t> encodeExr(const HdrImage& image) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    constexpr std::array<const char*, 3> kNames{"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        header.channels().insert(kNames[c], Imf::Channel(Imf::FLOAT));
        // OpenEXR reads through the same non-const slices that it writes through.
        auto* first = const_cast<char*>(reinterpret_cast<const char*>(&image.pixels[0][c]));
        frame.insert(kNames[c],
                     Imf::Slice(Imf::FLOAT, first, sizeof(glm::vec3), sizeof(glm::vec3) * std::size_t(image.width)));
    }
    VectorWriter stream;
    {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(frame);
        file.writePixels(image.height);
    }
    return std::move(stream.bytes);
}

}  // namespace probegi::io
