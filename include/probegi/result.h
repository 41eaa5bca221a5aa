#pragma once

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "probegi/export.h"

namespace probegi {

/// Why a call failed. The sentence in Error::message says what to do about it.
enum class ErrorCode {
    invalidArgument,  ///< a parameter is outside its documented range
    fileNotFound,     ///< nothing exists at the path
    fileUnreadable,   ///< the path exists but cannot be opened or read
    malformed,        ///< the bytes do not follow the format
    unsupported,      ///< valid input that needs a feature ProbeGI does not have
    writeFailed,      ///< the output could not be written; nothing was left half-written
    outOfMemory,      ///< an allocation on the host or the device failed
    cancelled,        ///< the progress callback asked to stop
    deviceLost,       ///< the GPU stopped responding; create a new device (the CPU backend still works)
};

/// A failure: a code for programs, one sentence for people.
struct Error {
    ErrorCode code = ErrorCode::invalidArgument;
    std::string message{};  ///< names the file or parameter, the reason, and what to do
};

/// Thrown by Result::value() if there is no value.
class PROBEGI_API BadResult : public std::exception {
public:
    explicit BadResult(Error error) : m_error(std::move(error)) {}
    const char* what() const noexcept override { return m_error.message.c_str(); }
    const Error& error() const noexcept { return m_error; }

private:
    Error m_error;
};

/// Throws BadResult; in a program compiled without exceptions, prints the message and aborts.
[[noreturn]] inline void throwBadResult(const Error& error) {
#if defined(__cpp_exceptions)
    throw BadResult(error);
#else
    std::fprintf(stderr, "%s\n", error.message.c_str());
    std::abort();
#endif
}

/// What every fallible call of the API returns: a T, or the Error that says why there is none. Nothing throws across
/// the API. Members are those of std::expected (C++23). Compilers warn about an ignored Result.
template <class T>
class [[nodiscard]] Result {
public:
    using value_type = T;
    using error_type = Error;

    Result() = default;
    Result(Error error) : m_state(std::in_place_index<1>, std::move(error)) {}
    template <class U = T>
    requires(std::is_constructible_v<T, U> && !std::is_same_v<std::remove_cvref_t<U>, Result> &&
             !std::is_same_v<std::remove_cvref_t<U>, Error>) explicit(!std::is_convertible_v<U, T>) Result(U&& value)
        : m_state(std::in_place_index<0>, std::forward<U>(value)) {}

    bool has_value() const noexcept { return m_state.index() == 0; }
    explicit operator bool() const noexcept { return has_value(); }

    /// Unchecked: there must be a value.
    T& operator*() & noexcept { return *std::get_if<0>(&m_state); }
    const T& operator*() const& noexcept { return *std::get_if<0>(&m_state); }
    T&& operator*() && noexcept { return std::move(**this); }
    T* operator->() noexcept { return std::get_if<0>(&m_state); }
    const T* operator->() const noexcept { return std::get_if<0>(&m_state); }

    /// Checked: see throwBadResult().
    T& value() & { return checked(), **this; }
    const T& value() const& { return checked(), **this; }
    T&& value() && { return checked(), std::move(**this); }
    template <class U>
    T value_or(U&& other) const& {
        return has_value() ? **this : static_cast<T>(std::forward<U>(other));
    }
    template <class U>
    T value_or(U&& other) && {
        return has_value() ? std::move(**this) : static_cast<T>(std::forward<U>(other));
    }

    /// Unchecked: there must be an error.
    const Error& error() const& noexcept { return *std::get_if<1>(&m_state); }
    Error&& error() && noexcept { return std::move(*std::get_if<1>(&m_state)); }

    /// Returns next(value), itself a Result, or the error.
    template <class Next>
    auto and_then(Next&& next) const& -> std::invoke_result_t<Next, const T&> {
        if (!has_value()) return error();
        return std::invoke(std::forward<Next>(next), **this);
    }
    template <class Next>
    auto and_then(Next&& next) && -> std::invoke_result_t<Next, T> {
        if (!has_value()) return std::move(*this).error();
        return std::invoke(std::forward<Next>(next), std::move(**this));
    }
    /// Returns a Result holding change(value), or the error.
    template <class Change>
    auto transform(Change&& change) const& -> Result<std::invoke_result_t<Change, const T&>> {
        if (!has_value()) return error();
        return made(std::forward<Change>(change), **this);
    }
    template <class Change>
    auto transform(Change&& change) && -> Result<std::invoke_result_t<Change, T>> {
        if (!has_value()) return std::move(*this).error();
        return made(std::forward<Change>(change), std::move(**this));
    }

private:
    void checked() const {
        if (!has_value()) throwBadResult(error());
    }
    template <class Change, class V>
    static auto made(Change&& change, V&& value) -> Result<std::invoke_result_t<Change, V>> {
        if constexpr (std::is_void_v<std::invoke_result_t<Change, V>>) {
            std::invoke(std::forward<Change>(change), std::forward<V>(value));
            return {};
        } else {
            return std::invoke(std::forward<Change>(change), std::forward<V>(value));
        }
    }

    std::variant<T, Error> m_state;
};

/// Success, or an Error.
template <>
class [[nodiscard]] Result<void> {
public:
    using value_type = void;
    using error_type = Error;

    Result() = default;
    Result(Error error) : m_error(std::move(error)) {}

    bool has_value() const noexcept { return !m_error; }
    explicit operator bool() const noexcept { return has_value(); }
    void operator*() const noexcept {}
    void value() const {
        if (m_error) throwBadResult(*m_error);
    }
    const Error& error() const& noexcept { return *m_error; }
    Error&& error() && noexcept { return std::move(*m_error); }

    template <class Next>
    auto and_then(Next&& next) const -> std::invoke_result_t<Next> {
        if (m_error) return *m_error;
        return std::invoke(std::forward<Next>(next));
    }
    template <class Change>
    auto transform(Change&& change) const -> Result<std::invoke_result_t<Change>> {
        if (m_error) return *m_error;
        if constexpr (std::is_void_v<std::invoke_result_t<Change>>) {
            std::invoke(std::forward<Change>(change));
            return {};
        } else {
            return std::invoke(std::forward<Change>(change));
        }
    }

private:
    std::optional<Error> m_error;
};

/// Shorthand for returning a failure from a function that returns a Result.
[[nodiscard]] inline Error fail(ErrorCode code, std::string message) {
    return Error{code, std::move(message)};
}

}  // namespace probegi
