#pragma once

#include <vector>

#include "shoal/core/options.hpp"

namespace shoal::analysis {

/// A table that files of studies and claims are written in.
struct FilePart {
  const char* name;
  const char* written;  ///< how it stands in the file
  const Schema& schema;
};

const std::vector<FilePart>& file_parts();

}  // namespace shoal::analysis
