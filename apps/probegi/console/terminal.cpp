#include "console/terminal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <optional>

#include "console/whole_progress.h"

namespace probegi::tool {

namespace {

constexpr double kQuietSeconds = 0.5;  // shorter stages draw nothing
constexpr int kBarCells = 28;

constexpr std::size_t kLongestSentence = 1500;  // bytes; messages may quote names of any length

/// One UTF-8 character.
struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 1;
    bool valid = false;
};

Character firstCharacter(std::string_view text) {
    const auto byte = [&](std::size_t i) { return std::uint32_t(static_cast<unsigned char>(text[i])); };
    const std::uint32_t lead = byte(0);
    if (lead < 0x80) return {lead, 1, true};
    const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
    if (lead < 0xc0 || lead > 0xf7 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0x7fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return {};
        code = code << 6 | (byte(i) & 0x3f);
    }
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < kSmallest[bytes] || code > 0x10ffff || surrogate) return {};
    return {code, bytes, true};
}

bool isControl(std::uint32_t code) {
    const bool turnsDirection =
        (code >= 0x200e && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || turnsDirection;
}

std::string oneLine(std::string_view text) {
    std::string line = plainText(text, kLongestSentence);
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

std::string timeLeft(double seconds) {
    if (seconds < 0) return {};
    const int whole = int(seconds + 0.5);
    if (whole < 60) return fmt::format(", {} s left", whole);
    return fmt::format(", {} min {:02} s left", whole / 60, whole % 60);
}

// Draws over one line of the terminal and clears it at the end of the stage.
class ProgressBar {
public:
    void draw(const ProgressReport& report) {
        if (report.fraction >= 1.0) return clear();
        if (report.secondsElapsed < kQuietSeconds) return;
        const int filled = std::clamp(int(report.fraction * kBarCells), 0, kBarCells);
        const std::string cells = std::string(filled, '#') + std::string(kBarCells - filled, '.');
        write(fmt::format("\r\033[K{:<22} [{}] {:3.0f} %{}", report.stage, cells, report.fraction * 100,
                          timeLeft(report.secondsLeft)));
        m_visible = true;
    }

    void clear() {
        if (m_visible) write("\r\033[K");
        m_visible = false;
    }

private:
    static void write(const std::string& text) {
        std::fputs(text.c_str(), stderr);
        std::fflush(stderr);
    }

    bool m_visible = false;
};

}  // namespace

Result<Context> makeContext(int threads) {
    ContextDesc desc;
    desc.threads = threads;
    const auto bar = std::make_shared<ProgressBar>();
    desc.log = [bar](LogLevel level, std::string_view line) {
        if (level != LogLevel::warning) return;
        bar->clear();
        printWarning(line);
    };
    if (isatty(STDERR_FILENO))
        desc.progress = [bar](const ProgressReport& report) {
            bar->draw(report);
            return true;
        };
    return Context::create(desc);
}

struct WholeBar::Impl {
    std::optional<WholeProgress> whole = {};
    std::string piece = {};
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    ProgressBar bar = {};

    void done(double share) {
        if (!whole || piece.empty() || !isatty(STDERR_FILENO)) return;
        const double fraction = std::min(whole->fraction(share), 0.999);
        const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        bar.draw({piece, fraction, elapsed, fraction > 0.01 ? elapsed / fraction - elapsed : -1});
    }
};

WholeBar::WholeBar() : m_impl(std::make_shared<Impl>()) {}

WholeBar::~WholeBar() {
    m_impl->bar.clear();
}

void WholeBar::plan(std::vector<double> guesses) {
    m_impl->whole.emplace(std::move(guesses));
    m_impl->start = std::chrono::steady_clock::now();
}

void WholeBar::begin(std::string piece) {
    if (m_impl->whole) m_impl->whole->begin();
    m_impl->piece = std::move(piece);
    done(0);
}

void WholeBar::done(double shareOfPiece) {
    m_impl->done(shareOfPiece);
}

void WholeBar::clear() {
    m_impl->bar.clear();
}

Result<Context> makeContext(int threads, WholeBar& whole) {
    ContextDesc desc;
    desc.threads = threads;
    desc.log = [shown = whole.m_impl](LogLevel level, std::string_view line) {
        if (level != LogLevel::warning) return;
        shown->bar.clear();
        printWarning(line);
    };
    desc.progress = [shown = whole.m_impl](const ProgressReport& report) {
        shown->done(report.fraction);
        return true;
    };
    return Context::create(desc);
}

struct LoopProgress::Impl {
    std::string stage;
    int total;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    ProgressBar bar = {};
};

LoopProgress::LoopProgress(std::string stage, int total)
    : m_impl(isatty(STDERR_FILENO) ? std::make_unique<Impl>(Impl{std::move(stage), total}) : nullptr) {}

LoopProgress::~LoopProgress() {
    if (m_impl) m_impl->bar.clear();
}

void LoopProgress::done(int count) {
    if (!m_impl || count <= 0) return;
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - m_impl->start).count();
    const double fraction = double(count) / double(m_impl->total);
    m_impl->bar.draw({m_impl->stage, std::min(fraction, 0.999), elapsed, elapsed / fraction - elapsed});
}

std::string plainText(std::string_view text, std::size_t most) {
    std::string plain;
    for (std::size_t at = 0; at < text.size();) {
        if (text.size() > most && at >= most / 2 && at < text.size() - most / 2) {
            plain += " ... ";
            at = text.size() - most / 2;
            while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80) ++at;
            continue;
        }
        const Character character = firstCharacter(text.substr(at));
        const bool space = text[at] == '\n' || text[at] == '\r' || text[at] == '\t';
        if (character.valid && !isControl(character.code))
            plain += text.substr(at, character.bytes);
        else
            plain += space ? ' ' : '?';
        at += character.bytes;
    }
    return plain;
}

int closeStandardOutput(int exitCode, std::error_code reason) {
    if (std::fflush(stdout) != 0)
        reason = std::error_code(errno, std::generic_category());
    else if (!std::ferror(stdout))
        return exitCode;
    const std::string why = reason ? fmt::format(" ({})", reason.message()) : std::string();
    const int failed =
        printError({ErrorCode::writeFailed,
                    fmt::format("standard output cannot be written{}; check where it is redirected", why)});
    return exitCode ? exitCode : failed;
}

void keepStandardStreams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        // Read-only, so that printing to a closed stream still fails.
        if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", O_RDONLY) != stream) return;
}

void printWarning(std::string_view sentence) {
    fmt::print(stderr, "warning: {}\n", oneLine(sentence));
}

int printError(const Error& error) {
    fmt::print(stderr, "error: {}\n", oneLine(error.message));
    return 1;
}

}  // namespace probegi::tool
