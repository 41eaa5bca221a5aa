#include "terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>

#include "whole_progress.h"

namespace probegi::tool {

namespace {

constexpr double kQuietSeconds = 0.5;  // shorter stages draw nothing
constexpr int kBarCells = 28;

std::string oneLine(std::string_view text) {
    std::string line(text);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

std::string timeLeft(double seconds) {
    if (seconds < 0) return {};
    const int whole = int(seconds + 0.5);
    if (whole < 60) return fmt::format(", {} s left", whole);
    return fmt::format(", {} min {:02} s left", whole / 60, whole % 60);
}

// Rewrites one line of the terminal and takes it away at the end of the stage.
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

void printWarning(std::string_view sentence) {
    fmt::print(stderr, "warning: {}\n", oneLine(sentence));
}

int printError(const Error& error) {
    fmt::print(stderr, "error: {}\n", oneLine(error.message));
    return 1;
}

}  // namespace probegi::tool
