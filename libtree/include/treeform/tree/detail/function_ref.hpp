#pragma once
/// \file
/// A reference to a callable: the parameter type of compiled functions that call a lambda.

#include <memory>
#include <type_traits>
#include <utility>

namespace treeform::detail {

template <class Signature>
class function_ref;

/// Refers to a callable, which must outlive the call to which this is passed. Two words; never
/// null.
template <class R, class... Args>
class function_ref<R(Args...)> {
  public:
    template <class F>
    requires(!std::is_same_v<std::remove_cvref_t<F>, function_ref> &&
             std::is_invocable_r_v<R, F&, Args...>)
        function_ref(F&& f)  // NOLINT: implicit, as a reference is
        : object_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
          call_([](void* object, Args... args) -> R {
              return (*static_cast<std::remove_reference_t<F>*>(object))(
                  std::forward<Args>(args)...);
          }) {}

    R operator()(Args... args) const { return call_(object_, std::forward<Args>(args)...); }

  private:
    void* object_;
    R (*call_)(void*, Args...);
};

}  // namespace treeform::detail
