#pragma once

#include <new>
#include <stdexcept>
#include <type_traits>

#include "probegi/result.h"
#include "vulkan/device/vk.h"

namespace probegi::vulkan {

/// Thrown inside this layer and caught by guarded() at its boundary.
struct Failure : std::runtime_error {
    Failure(ErrorCode c, const std::string& message) : std::runtime_error(message), code(c) {}
    ErrorCode code;
};

/// The Error for the current exception; call it in a catch block. `doing` completes "while ...".
Error currentError(const char* doing) noexcept;

/// Runs `body` and turns exceptions into an Error: nothing throws across the API.
template <class Body>
auto guarded(const char* doing, const Body& body) noexcept -> Result<std::invoke_result_t<Body>> {
    try {
        if constexpr (std::is_void_v<std::invoke_result_t<Body>>) {
            body();
            return {};
        } else {
            return body();
        }
    } catch (...) {
        return currentError(doing);
    }
}

/// The inverse, for a Result within this layer.
template <class T>
T orThrow(Result<T> result) {
    if (!result) throw Failure(result.error().code, result.error().message);
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace probegi::vulkan
