#pragma once

#include <filesystem>

namespace probegi::test {

/// Root folder of the checkout.
std::filesystem::path sourceFolder();

}  // namespace probegi::test
