#pragma once

#include <fmt/format.h>

#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "probegi/result.h"

namespace probegi::io {

/// Thrown by readers if a file cannot be used, and caught within this layer by guarded().
struct Refused {
    Error error;
};

template <class... Args>
[[noreturn]] void refuse(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
    throw Refused{Error{code, fmt::format(format, std::forward<Args>(args)...)}};
}

template <class... Args>
[[noreturn]] void refuseMalformed(fmt::format_string<Args...> format, Args&&... args) {
    throw Refused{Error{ErrorCode::malformed, fmt::format(format, std::forward<Args>(args)...)}};
}

/// Runs body() and turns all exceptions, including libraries', into an Error that begins with `name`. Libraries'
/// messages are for developers and dropped; callers reword the useful ones.
template <class Body>
auto guarded(std::string_view name, const Body& body) -> Result<std::invoke_result_t<Body>> {
    const auto sentence = [&](std::string_view what) { return fmt::format("{}: {}", name, what); };
    try {
        if constexpr (std::is_void_v<std::invoke_result_t<Body>>) {
            body();
            return {};
        } else {
            return body();
        }
    } catch (const Refused& refused) {
        return fail(refused.error.code, sentence(refused.error.message));
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::outOfMemory, sentence("needs more memory than is available"));
    } catch (const std::exception&) {
        return fail(ErrorCode::malformed, sentence("is damaged or of an unknown kind; save it again"));
    }
}

}  // namespace probegi::io
