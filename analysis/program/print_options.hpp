#pragma once

#include <string>

#include "shoal/core/registry.hpp"

namespace shoal::program {

// What `shoal describe` says of declared options: meaning, range, unit and default of each.

/// `path` stands before the names of the options.
void print_schema(const Schema& schema, const std::string& path);
void print_member(const RegistryBase& family, const MemberInfo& member, const std::string& path);
/// What a dotted key names. Throws InputError at its first unknown part.
void print_key(const Schema& schema, const std::string& key);

}  // namespace shoal::program
