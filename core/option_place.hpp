#pragma once

#include <functional>
#include <string>

#include "shoal/core/registry.hpp"

namespace shoal {

/// What a dotted key (`behaviour.rigid_registration.ownship_weight`) names in a declared struct.
struct OptionPlace {
  std::string key;
  const Option* option = nullptr;      ///< the last option on the way
  const Setting* fallback = nullptr;   ///< its default; nullptr: has none
  const MemberInfo* member = nullptr;  ///< set if the key ends with a member of a choice
  bool is_kind = false;                ///< the key ends with `.kind`, behind an option that is one
};

/// Walks a dotted key. Throws InputError (at `origin`) at the first part that is not known.
OptionPlace locate(const Schema& schema, const std::string& key, const Origin& origin = {});

/// Calls `visitor` for every value of a written struct (write_options) that is no table itself, and
/// for every choice, also below choices whether or not their kind is the chosen one.
void visit_options(const Schema& schema, Setting& written,
                   const std::function<void(const Option&, Setting& value)>& visitor);

}  // namespace shoal
