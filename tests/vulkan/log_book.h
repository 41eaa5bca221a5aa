#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "probegi/context.h"

namespace probegi::test {

/// A context that records the log. Messages of the validation layer fail the test.
class LogBook {
public:
    LogBook() : m_lines(std::make_shared<std::vector<std::string>>()) {
        ContextDesc desc;
        desc.threads = 1;
        desc.log = [lines = m_lines](LogLevel, std::string_view line) { lines->emplace_back(line); };
        context = std::make_unique<Context>(*Context::create(desc));
    }
    ~LogBook() {
        for (const std::string& line : *m_lines) EXPECT_FALSE(line.starts_with("Vulkan validation")) << line;
    }
    LogBook(const LogBook&) = delete;
    LogBook& operator=(const LogBook&) = delete;

    operator const Context&() const noexcept { return *context; }
    /// Number of lines that contain a text.
    int count(std::string_view text) const {
        int found = 0;
        for (const std::string& line : *m_lines) found += line.find(text) != std::string::npos;
        return found;
    }
    std::string all() const {
        std::string text;
        for (const std::string& line : *m_lines) text += line + "\n";
        return text;
    }

    std::unique_ptr<Context> context;

private:
    std::shared_ptr<std::vector<std::string>> m_lines;
};

}  // namespace probegi::test
