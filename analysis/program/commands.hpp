#pragma once

#include <string>
#include <vector>

namespace shoal::program {

struct RunArguments {
  std::string scenario;
  std::vector<std::string> sets;
  std::string seed;  ///< as written; empty: the scenario's own
  std::string out;
  int threads = 1;
};

// Each command prints to stdout, throws InputError or SystemError, and knows nothing of CLI11.
void run(const RunArguments& arguments);
void list(const std::string& family);
void describe(const std::string& name_or_key);
void check(const std::vector<std::string>& files);

}  // namespace shoal::program
