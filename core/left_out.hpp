#pragma once

#include <initializer_list>
#include <memory>
#include <string>

#include "shoal/core/registry.hpp"

namespace shoal {

/// Lists members whose library this build was made without, in the place of their own source
/// (core/cmake/components.cmake): they are shown, and choosing one is an error that names the
/// option.
template <class Family>
struct RegisterLeftOut {
  RegisterLeftOut(const std::string& option, std::initializer_list<const char*> names) {
    for (const char* name : names) {
      Registry<Family>::instance().add(
          {name, "not in this build (" + option + "=OFF)",
           []() -> const Schema& {
             static const Schema none;
             return none;
           },
           [](const Setting&, const std::string&) {},
           [](const Setting& table, const std::string&) { return table; }, nullptr, option},
          [](const Setting&, const std::string&) -> std::unique_ptr<Family> { return nullptr; });
    }
  }
};

}  // namespace shoal
