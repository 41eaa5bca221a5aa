#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace probegi {

/// Why a call failed. The sentence in Error::message says what to do about it.
enum class ErrorCode {
    invalidArgument,  ///< a parameter is outside its documented range
    fileNotFound,     ///< the path names nothing
    fileUnreadable,   ///< the path exists but cannot be opened or read
    malformed,        ///< the bytes do not follow the format
    unsupported,      ///< valid input that needs a feature ProbeGI does not have
    writeFailed,      ///< the output could not be written; nothing was left half-written
    outOfMemory,      ///< an allocation or a device refused
    cancelled,        ///< the progress callback asked to stop
    deviceLost,       ///< the GPU stopped answering; make a new device, the CPU backend still works
};

/// A failure: a code for programs, one sentence for people.
struct Error {
    ErrorCode code = ErrorCode::invalidArgument;
    std::string message;  ///< names the file or parameter, the reason, and what to do
};

/// Every fallible call of the API returns one of these; nothing throws across the API.
template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for returning a failure from a function that returns a Result.
[[nodiscard]] inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
    return tl::unexpected<Error>(Error{code, std::move(message)});
}

}  // namespace probegi
