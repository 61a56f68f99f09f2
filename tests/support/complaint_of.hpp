#pragma once

#include <string>

#include "shoal/core/error.hpp"

namespace shoal::tests {

/// What the InputError says that this throws, "" if it throws none.
template <class Act>
std::string complaint_of(Act act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace shoal::tests
