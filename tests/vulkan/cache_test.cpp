// The pipeline cache file: whatever it contains or happens to it, the device works.
#include <sys/stat.h>

#include <fstream>
#include <random>
#include <thread>

#include "vulkan/hooks.h"
#include "vulkan/log_book.h"
#include "vulkan/small_world.h"

namespace probegi::test {

namespace {

namespace fs = std::filesystem;

std::vector<char> bytesOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write(const fs::path& file, const std::vector<char>& bytes) {
    std::ofstream out(file, std::ios::binary);
    out.write(bytes.data(), std::streamsize(bytes.size()));
}

class VulkanCache : public testing::Test {
protected:
    void SetUp() override {
        hooks().reset();
        m_folder = fs::temp_directory_path() / ("probegi_cache_" + std::to_string(std::random_device()()));
        fs::create_directories(m_folder);
    }
    void TearDown() override { fs::remove_all(m_folder); }

    Result<vulkan::Device> open(const fs::path& folder) const {
        vulkan::OpenDesc desc;
        desc.cacheFolder = folder;
        desc.getInstanceProcAddr = hookedLoader;
        return vulkan::Device::open(log, desc);
    }
    fs::path folder() const { return m_folder / "cache"; }
    // The only file in the folder; there must be no other.
    fs::path file() const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder())) files.push_back(entry.path());
        EXPECT_EQ(files.size(), 1u);
        return files.empty() ? fs::path() : files.front();
    }
    // Opens a device, compiles a few passes, closes it.
    void use() const {
        const auto device = open(folder());
        ASSERT_TRUE(device) << device.error().message;
        work(*device);
    }
    void work(const vulkan::Device& device) const {
        auto field = vulkan::makeField(log, device, world.desc, world.desc);
        ASSERT_TRUE(field) << field.error().message;
        ASSERT_TRUE(field->update(std::vector<RayDatum>(18 * 16)));
        EXPECT_TRUE(finite(field->irradiance(world.query())));
    }

    LogBook log;
    const SmallWorld world;

private:
    fs::path m_folder;
};

}  // namespace

TEST_F(VulkanCache, isWrittenAndReadBack) {
    use();
    const std::vector<char> first = bytesOf(file());
    EXPECT_GT(first.size(), 24u);
    const auto written = fs::last_write_time(file());
    use();
    EXPECT_EQ(bytesOf(file()), first);
    EXPECT_EQ(fs::last_write_time(file()), written) << "nothing new was compiled, but the file was written";
    EXPECT_EQ(log.count("shader cache"), 0) << log.all();
}

TEST_F(VulkanCache, savesWhenAsked) {
    const auto device = open(folder());
    ASSERT_TRUE(device);
    EXPECT_TRUE(device->savePipelines());
    EXPECT_FALSE(fs::exists(folder())) << "nothing was compiled";
    work(*device);
    EXPECT_TRUE(device->savePipelines());
    EXPECT_TRUE(fs::exists(file()));
}

TEST_F(VulkanCache, withoutAFolderNothingIsWritten) {
    const auto device = open({});
    ASSERT_TRUE(device);
    work(*device);
    EXPECT_TRUE(device->savePipelines());
}

TEST_F(VulkanCache, everyDamageIsDetectedReportedAndRepaired) {
    use();
    const fs::path path = file();
    const std::vector<char> good = bytesOf(path);
    std::vector<std::vector<char>> damaged = {{}, {'x'}, std::vector<char>(4096, '\0'), std::vector<char>(999, 'y')};
    for (const std::size_t kept : {std::size_t(1), std::size_t(23), std::size_t(24), std::size_t(25), good.size() - 1})
        damaged.emplace_back(good.begin(), good.begin() + std::ptrdiff_t(kept));
    damaged.push_back(good);
    damaged.back().push_back('z');
    for (std::size_t at = 0; at < good.size(); at += std::max<std::size_t>(1, good.size() / 40)) {
        damaged.push_back(good);
        damaged.back()[at] = char(damaged.back()[at] ^ (1 << at % 8));
    }
    int reported = 0;
    for (const std::vector<char>& bytes : damaged) {
        write(path, bytes);
        const auto device = open(folder());
        ASSERT_TRUE(device) << device.error().message;
        EXPECT_EQ(log.count("is damaged and was ignored"), ++reported) << bytes.size() << " bytes";
    }
    write(path, damaged.back());
    use();
    EXPECT_EQ(bytesOf(path).size(), good.size());
    use();
    EXPECT_EQ(log.count("is damaged"), reported + 1) << "the file was not repaired";
}

TEST_F(VulkanCache, aFileOfAnotherDriverIsIgnored) {
    hooks().properties = [](VkPhysicalDeviceProperties& p) { p.pipelineCacheUUID[3] ^= 0x40; };
    use();  // the other driver's name, but this one's contents
    EXPECT_EQ(log.count("another driver"), 0);
    use();
    EXPECT_EQ(log.count("of another driver and was ignored"), 1) << log.all();
}

TEST_F(VulkanCache, aFolderThatCannotBeMadeIsReported) {
    const fs::path blocked = fs::path(folder()).parent_path() / "file";
    write(blocked, {'x'});
    for (const fs::path& path : {blocked, blocked / "below", blocked / "below" / "that"}) {
        const int before = log.count("could not be written");
        {
            const auto device = open(path);
            ASSERT_TRUE(device) << device.error().message;
            work(*device);
            const auto saved = device->savePipelines();
            ASSERT_FALSE(saved);
            EXPECT_EQ(saved.error().code, ErrorCode::writeFailed);
            EXPECT_NE(saved.error().message.find("recompiled"), std::string::npos) << saved.error().message;
        }
        EXPECT_EQ(log.count("could not be written"), before + 1) << log.all();
    }
    EXPECT_EQ(bytesOf(blocked), std::vector<char>{'x'});
}

TEST_F(VulkanCache, aPipeOrADeviceInTheFilesPlaceIsNotRead) {
    use();
    const fs::path path = file();
    fs::remove(path);
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    use();  // would wait for a writer
    EXPECT_EQ(log.count("is damaged"), 1);
    EXPECT_TRUE(fs::is_regular_file(path)) << "it was not made anew";
    fs::remove(path);
    fs::create_symlink("/dev/zero", path);
    use();  // would read forever
    EXPECT_EQ(log.count("is damaged"), 2);
    EXPECT_TRUE(fs::is_character_file("/dev/zero"));
}

TEST_F(VulkanCache, aFolderInTheFilesPlaceIsHandled) {
    use();
    const fs::path path = file();
    fs::remove(path);
    fs::create_directories(path / "full");
    use();
    EXPECT_EQ(log.count("is damaged"), 1);
    EXPECT_EQ(log.count("could not be written"), 1);
    EXPECT_EQ(file(), path) << "a temporary file was left";
}

TEST_F(VulkanCache, devicesThatWriteAtOnceLeaveOneGoodFile) {
    std::vector<std::thread> threads;
    for (int i = 0; i < 3; ++i)
        threads.emplace_back([&] {
            // Not the counting hooks, which are not thread-safe.
            vulkan::OpenDesc desc;
            desc.cacheFolder = folder();
            const Context silent = *Context::create({.threads = 1});
            for (int round = 0; round < 3; ++round) {
                const auto device = vulkan::Device::open(silent, desc);
                ASSERT_TRUE(device);
                auto field = vulkan::makeField(silent, *device, world.desc, world.desc);
                ASSERT_TRUE(field && field->update(std::vector<RayDatum>(18 * 16)));
                EXPECT_TRUE(device->savePipelines());
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_TRUE(fs::exists(file()));
    use();
    EXPECT_EQ(log.count("damaged"), 0) << log.all();
}

}  // namespace probegi::test
