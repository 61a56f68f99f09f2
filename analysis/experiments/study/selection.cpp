#include "shoal/analysis/experiments/study/selection.hpp"

#include <algorithm>

#include "shoal/analysis/experiments/study/factor.hpp"

namespace shoal::analysis {

CellSelection::CellSelection(const Setting& table) : origin_(table.origin) {
  if (!table.is_table()) {
    throw InputError(table.origin,
                     "cells are selected by a table, { factor = \"label\" }, not by " +
                         std::string(table.type_name()));
  }
  for (const auto& [factor, value] : table.table()) {
    std::vector<std::string> labels;
    if (const auto* list = std::get_if<Setting::List>(&value.value)) {
      for (const Setting& entry : *list) labels.push_back(label_of(entry));
    } else {
      labels.push_back(label_of(value));
    }
    if (labels.empty()) throw InputError(value.origin, factor + " selects no label");
    wanted_.emplace_back(factor, std::move(labels));
  }
}

std::vector<std::string> CellSelection::factors() const {
  std::vector<std::string> names;
  for (const auto& [factor, labels] : wanted_) names.push_back(factor);
  return names;
}

bool CellSelection::names_one(const std::string& factor) const {
  return std::ranges::any_of(wanted_, [&](const auto& entry) {
    return entry.first == factor && entry.second.size() == 1;
  });
}

bool CellSelection::holds(std::span<const std::string> names,
                          std::span<const std::string> labels) const {
  return std::ranges::all_of(wanted_, [&](const auto& entry) {
    const auto place = std::ranges::find(names, entry.first);
    if (place == names.end()) return false;
    const std::string& label = labels[static_cast<std::size_t>(place - names.begin())];
    return std::ranges::find(entry.second, label) != entry.second.end();
  });
}

std::string CellSelection::text() const {
  std::string text;
  for (const auto& [factor, labels] : wanted_) {
    text += (text.empty() ? "" : ", ") + factor + " = ";
    for (std::size_t i = 0; i < labels.size(); ++i) text += (i ? " or " : "") + labels[i];
  }
  return text;
}

std::vector<CellSelection> cell_selections(const Setting& setting, const std::string& name) {
  const auto* entries = std::get_if<Setting::List>(&setting.value);
  const bool none = entries ? entries->empty() : setting.is_table() && setting.table().empty();
  if (none) {
    throw InputError(setting.origin,
                     name + " takes { factor = \"label\" }, or a list of such tables");
  }
  if (!entries) return {CellSelection(setting)};
  std::vector<CellSelection> all;
  for (const Setting& entry : *entries) all.emplace_back(entry);
  return all;
}

std::vector<std::string> factors_of(const CellSelection& one,
                                    const std::vector<CellSelection>& others) {
  std::vector<std::string> factors = one.factors();
  for (const CellSelection& other : others) {
    for (const std::string& name : other.factors()) {
      if (std::ranges::find(factors, name) == factors.end()) factors.push_back(name);
    }
  }
  return factors;
}

}  // namespace shoal::analysis
