// SPDX-License-Identifier: MIT
/// The type of callback parameters.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

template <class Signature>
class FunctionRef;

/// A function type that takes Args and returns a value that converts to Result.
template <class Function, class Result, class... Args>
concept CallableFunction = std::is_function_v<Function> && std::is_invocable_r_v<Result, Function&, Args...>;

/// Any other type that can be called with Args and returns a value that converts to Result. Callable is a type or a
/// reference, as a forwarding reference deduces it. The class Reference that is made from it is excluded, since it is
/// copied.
template <class Callable, class Reference, class Result, class... Args>
concept CallableObject =
    !std::same_as<std::remove_cvref_t<Callable>, Reference> && !std::is_function_v<std::remove_reference_t<Callable>> &&
    std::is_invocable_r_v<Result, Callable&, Args...>;

/// A reference to a callable that takes Args and returns a Result: a lambda, a function, a std::function.
///
/// It owns nothing: the callable must live as long as it is called. A temporary lambda passed to a call of the library
/// does, since such calls keep no callback when they return. Two pointers; copied freely; no allocation.
///
/// It is empty if it was made from an empty std::function or from a null pointer to a function. Calls of the library
/// reject an empty reference with InvalidArgument.
template <class Result, class... Args>
class FunctionRef<Result(Args...)> {
 public:
  /// Refers to an object: a lambda, a std::function.
  template <CallableObject<FunctionRef, Result, Args...> Callable>
  // Not explicit, so that callbacks are passed as they are. NOLINTNEXTLINE(bugprone-forwarding-reference-overload)
  FunctionRef(Callable&& callable) noexcept
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
        call_(call_object<std::remove_reference_t<Callable>>) {
    // Types that can be made from a null pointer can be empty: pointers to functions, std::function.
    if constexpr (std::is_constructible_v<std::remove_cvref_t<Callable>, std::nullptr_t>) {
      if (callable == nullptr) call_ = nullptr;
    }
  }

  /// Refers to a function.
  template <CallableFunction<Result, Args...> Function>
  FunctionRef(Function& function) noexcept  // NOLINT(google-explicit-constructor)
      : function_(reinterpret_cast<void (*)()>(&function)), call_(call_function<Function>) {}

  /// Whether the reference is not empty.
  [[nodiscard]] explicit operator bool() const noexcept { return call_ != nullptr; }
  /// Calls the callable. The reference must not be empty.
  Result operator()(Args... args) const { return call_(*this, std::forward<Args>(args)...); }

 private:
  template <class Object>
  static Result call_object(const FunctionRef& self, Args... args) {
    return static_cast<Result>(std::invoke(*static_cast<Object*>(self.object_), std::forward<Args>(args)...));
  }
  template <class Function>
  static Result call_function(const FunctionRef& self, Args... args) {
    return static_cast<Result>(reinterpret_cast<Function*>(self.function_)(std::forward<Args>(args)...));
  }

  union {
    void* object_;
    void (*function_)();
  };
  Result (*call_)(const FunctionRef&, Args...);
};

}  // namespace shaftcull
