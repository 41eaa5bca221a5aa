// Files that are cut off, damaged, foreign or made to do harm.
#include <gmock/gmock.h>

#include <filesystem>

#include "field_file/field_bytes.h"
#include "probegi/io.h"
#include "raw_file.h"
#include "saved_field.h"

namespace probegi::test {
namespace {

using testing::HasSubstr;

const FileBytes& good() {
    static const FileBytes file = encodeField(someField());
    return file;
}

void expectRefused(const FileBytes& file, ErrorCode code, const std::string& words, const ReadLimits& limits = {}) {
    const auto loaded = loadFieldFromMemory("test.field", file, limits);
    ASSERT_FALSE(loaded) << "was read, but should say: " << words;
    EXPECT_EQ(loaded.error().code, code) << loaded.error().message;
    EXPECT_THAT(loaded.error().message, testing::StartsWith("test.field: "));
    EXPECT_THAT(loaded.error().message, HasSubstr(words));
    EXPECT_LT(loaded.error().message.size(), 300u);
}

/// The good file with a chunk of other, unpacked, content.
FileBytes withContent(const std::string& name, const ByteWriter& content) {
    RawFile raw = takenApart(good());
    RawChunk& chunk = raw.chunk(name);
    chunk.flags &= ~2u;
    chunk.stored.clear();
    for (const std::byte byte : content.bytes()) chunk.stored.push_back(std::uint8_t(byte));
    chunk.unpackedBytes = chunk.stored.size();
    return putTogether(raw);
}

template <class Spoil>
FileBytes spoiled(const Spoil& spoil) {
    RawFile raw = takenApart(good());
    spoil(raw);
    return putTogether(raw);
}

TEST(HostileFieldFile, theGoodOneIsGood) {
    ASSERT_TRUE(loadFieldFromMemory("test.field", good()));
}

TEST(HostileFieldFile, cutOffAnywhere) {
    for (std::size_t length = 0; length < good().size(); ++length) {
        const auto loaded = loadFieldFromMemory("test.field", std::span(good()).first(length));
        ASSERT_FALSE(loaded) << length;
        ASSERT_EQ(loaded.error().code, ErrorCode::malformed) << length;
        ASSERT_THAT(loaded.error().message, HasSubstr(length < 8 ? "is not a field" : "is cut off")) << length;
    }
    FileBytes longer = good();
    longer.push_back(0);
    expectRefused(longer, ErrorCode::malformed, "should have");
}

TEST(HostileFieldFile, everyBitThatFlipsIsNoticed) {
    FileBytes file = good();
    for (std::size_t at = 0; at < file.size(); ++at) {
        file[at] ^= std::uint8_t(1u << (at % 8));
        ASSERT_FALSE(loadFieldFromMemory("test.field", file)) << at;
        file[at] ^= std::uint8_t(1u << (at % 8));
    }
}

TEST(HostileFieldFile, foreignFiles) {
    const std::string text = "{\"asset\": {\"version\": \"2.0\"}}\n and much more of it";
    expectRefused({text.begin(), text.end()}, ErrorCode::malformed, "is not a field of ProbeGI");
    expectRefused({0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, ErrorCode::malformed, "is not a field of ProbeGI");
    FileBytes asText = good();
    asText.erase(asText.begin() + 5);  // a carriage return
    expectRefused(asText, ErrorCode::malformed, "is not a field of ProbeGI");
}

TEST(HostileFieldFile, laterVersions) {
    expectRefused(spoiled([](RawFile& raw) { raw.version = 2; }), ErrorCode::unsupported, "is of version 2");
    RawChunk news{"NEWS", 0, 3, {1, 2, 3}};
    EXPECT_TRUE(loadFieldFromMemory("test.field", spoiled([&](RawFile& raw) { raw.chunks.push_back(news); })))
        << "what may be skipped is skipped";
    news.flags = 1;
    expectRefused(spoiled([&](RawFile& raw) { raw.chunks.push_back(news); }), ErrorCode::unsupported,
                  "a part NEWS that this ProbeGI does not know");
    news.name = "\x1b[2J";
    expectRefused(spoiled([&](RawFile& raw) { raw.chunks.push_back(news); }), ErrorCode::unsupported, "a part ???J");
    expectRefused(spoiled([](RawFile& raw) { raw.chunk("IRRA").flags |= 4; }), ErrorCode::unsupported,
                  "IRRA that is stored in a way");
}

TEST(HostileFieldFile, chunksThatAreMissingOrTooMany) {
    for (const char* name : {"DESC", "SETT", "PROB", "IRRA", "VISI", "STAT", "MWRD"})
        expectRefused(spoiled([&](RawFile& raw) {
                          std::erase_if(raw.chunks, [&](const RawChunk& c) { return c.name == name; });
                      }),
                      ErrorCode::malformed, std::string("lacks its part ") + name);
    expectRefused(
        spoiled([](RawFile& raw) { std::erase_if(raw.chunks, [](const RawChunk& c) { return c.name[0] == 'M'; }); }),
        ErrorCode::malformed, "needs FieldSettings::masks");
    expectRefused(spoiled([](RawFile& raw) { raw.chunks.push_back(raw.chunk("STAT")); }), ErrorCode::malformed,
                  "its part STAT twice");
    EXPECT_TRUE(loadFieldFromMemory("test.field", spoiled([](RawFile& raw) {
                                        std::erase_if(raw.chunks, [](const RawChunk& c) {
                                            return c.name == "MADE" || c.name == "CONV";
                                        });
                                    })));
    EXPECT_TRUE(loadFieldFromMemory("test.field",
                                    spoiled([](RawFile& raw) { std::reverse(raw.chunks.begin(), raw.chunks.end()); })))
        << "in any order";
}

TEST(HostileFieldFile, hugeLengthsAllocateNothing) {
    for (const std::uint64_t huge : {std::uint64_t(1) << 40, std::uint64_t(1) << 62, ~std::uint64_t(0)})
        for (const char* name : {"DESC", "IRRA", "VISI", "STAT", "MWRD", "CONV", "MADE"}) {
            const FileBytes file = spoiled([&](RawFile& raw) {
                raw.chunk(name).unpackedBytes = huge / 60 * 60;
                raw.chunk(name).flags |= 2u;
            });
            const auto loaded = loadFieldFromMemory("test.field", file);
            ASSERT_FALSE(loaded) << name;
            EXPECT_TRUE(loaded.error().code == ErrorCode::outOfMemory || loaded.error().code == ErrorCode::malformed);
        }
    expectRefused(spoiled([](RawFile& raw) {
                      raw.chunk("CONV").unpackedBytes = std::uint64_t(1) << 31;
                      raw.chunk("CONV").flags |= 2u;
                  }),
                  ErrorCode::outOfMemory, "raise --limit", {.megabytes = 1, .name = "--limit"});
    expectRefused(spoiled([](RawFile& raw) {
                      raw.chunk("CONV").flags |= 2u;
                      raw.chunk("CONV").unpackedBytes = 64;
                  }),
                  ErrorCode::malformed, "CONV cannot be unpacked");
    expectRefused(spoiled([](RawFile& raw) {
                      raw.chunk("MADE").flags &= ~2u;
                      raw.chunk("MADE").unpackedBytes += 1;
                  }),
                  ErrorCode::malformed, "two lengths");
}

TEST(HostileFieldFile, valuesThatNoFieldHas) {
    const auto desc = [](std::int32_t rays, std::uint32_t rules, std::int32_t counts, float spacing) {
        ByteWriter bytes;
        bytes.put(std::uint64_t(1));
        for (const std::int32_t value : {rays, 16, 4, 6, 4}) bytes.put(value);
        bytes.put(rules);
        bytes.put(1u);  // relocation
        bytes.put(0u);
        bytes.put(2u);  // volumes
        for (const std::int32_t each : {counts, 2}) {
            bytes.put(glm::vec3(0));
            bytes.put(glm::vec3(spacing));
            bytes.put(glm::ivec3(each));
            bytes.put(glm::quat(1, 0, 0, 0));
            bytes.put(0u);
        }
        return withContent("DESC", bytes);
    };
    expectRefused(desc(7, 0, 2, 1), ErrorCode::malformed, "raysPerProbe is 7");
    expectRefused(desc(16, 9, 2, 1), ErrorCode::unsupported, "rules number 9");
    expectRefused(desc(16, 0, -2, 1), ErrorCode::malformed, "counts is -2");
    expectRefused(desc(16, 0, 1024, 1), ErrorCode::malformed, "number of probes");
    expectRefused(desc(16, 0, 2, std::nanf("")), ErrorCode::malformed, "spacing");
    expectRefused(desc(16, 0, 200, 1), ErrorCode::malformed, "its part IRRA has");
    ByteWriter volumes;
    for (int i = 0; i < 10; ++i) volumes.put(0u);
    volumes.put(33u);
    expectRefused(withContent("DESC", volumes), ErrorCode::malformed, "33 volumes");
    ByteWriter few;
    few.put(1u);
    expectRefused(withContent("DESC", few), ErrorCode::malformed, "volumes end too early");
    expectRefused(withContent("SETT", few), ErrorCode::malformed, "settings end too early");
    ByteWriter time;
    time.put(5);
    time.put(6);  // more turns than frames
    time.put(glm::ivec3(0));
    time.put(glm::ivec3(0));
    expectRefused(withContent("PROB", time), ErrorCode::malformed, "frame 5");
    time.put(0);
    expectRefused(withContent("PROB", time), ErrorCode::malformed, "4 bytes too many");
}

TEST(HostileFieldFile, masksThatPointElsewhere) {
    const SavedField saved = someField();
    const auto words = [&](std::size_t at, std::uint32_t word, std::size_t drop = 0) {
        ByteWriter bytes;
        const auto all = saved.settings.masks->words();
        for (std::size_t i = 0; i + drop < all.size(); ++i) bytes.put(i == at ? word : all[i]);
        return withContent("MWRD", bytes);
    };
    EXPECT_TRUE(loadFieldFromMemory("test.field", words(0, saved.settings.masks->words()[0])));
    expectRefused(words(0, 0xffffffffu), ErrorCode::malformed, "masks of slot 0");
    expectRefused(words(4, 3), ErrorCode::malformed, "masks of slot 2");
    expectRefused(words(4, saved.settings.masks->words()[4] + 1), ErrorCode::malformed, "masks of slot 2");
    expectRefused(words(3, 5), ErrorCode::malformed, "masks of slot 1");  // a sixth cluster of five
    expectRefused(words(0, 0, 1), ErrorCode::malformed, "whole number of cubes");
    expectRefused(words(0, 0, 100000), ErrorCode::malformed, "whole number of cubes");
}

// A picture of the clusters asks the masks for every slot, whatever the guard.
TEST(HostileFieldFile, masksOfFewerProbes) {
    const Halls halls(0.17f);
    SavedField saved = someField();
    FieldDesc fewer = saved.snapshot.desc;
    fewer.volumes.pop_back();
    saved.settings.masks = halls.bake({.factor = 2}, fewer);
    for (const LeakGuard guard : {LeakGuard::moments, LeakGuard::masks}) {
        saved.settings.guard = guard;
        const auto kept = saveField("unused.field", saved);
        ASSERT_FALSE(kept);
        EXPECT_THAT(kept.error().message, HasSubstr("its masks are of other volumes than its probes"));
    }
    // The chunks of a field of fewer probes, with masks that are its own.
    SavedField small = saved;
    Field field = Field::create(halls.context, fewer).value();
    small.snapshot = field.read().value();
    const RawFile masks = takenApart(encodeField(small));
    saved = someField();
    saved.settings.guard = LeakGuard::moments;
    RawFile raw = takenApart(encodeField(saved));
    for (const char* name : {"MASK", "MWRD"}) raw.chunk(name) = RawFile(masks).chunk(name);
    expectRefused(putTogether(raw), ErrorCode::malformed, "its masks are of other volumes than its probes");
}

// A file of holes takes no room on the disk, and would take all memory.
TEST(HostileFieldFile, theLengthIsCheckedBeforeMemoryIsTaken) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "holes.field";
    ASSERT_TRUE(writeFile(path, good()));
    std::filesystem::resize_file(path, std::uintmax_t(1) << 38);
    const auto loaded = loadField(path);
    std::filesystem::remove(path);
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().code, ErrorCode::malformed);
    EXPECT_THAT(loaded.error().message, HasSubstr("it has 274877906944 bytes and should have"));
}

}  // namespace
}  // namespace probegi::test
