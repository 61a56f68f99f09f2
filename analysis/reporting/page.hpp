#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace shoal::analysis {

/// A page of the library's folder `report` with its styles, scripts and data inside it: one file
/// that asks for no other. Throws SystemError if a part of it is missing.
std::string whole_page(const std::string& name, const nlohmann::ordered_json& data);

}  // namespace shoal::analysis
