#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "shoal/core/error.hpp"
#include "tests/support/scratch_folder.hpp"

/// What every fuzz target has: bytes in, and either a result or an InputError. All else
/// (another exception, a crash, a finding of a sanitizer, ten seconds, a gigabyte) is a fault.
namespace shoal::tests {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// The same file for every input: names in messages and caches do not grow with their number.
inline std::filesystem::path fuzzed_file(const std::string& name, std::string_view content) {
  static const ScratchFolder folder;
  return folder.write(name, std::string(content));
}

/// Aborts, so that the fuzzer keeps the input.
[[noreturn]] void fault(const std::string& why);

template <class Read>
void must_answer(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    if (message.empty()) fault("an empty message");
    if (message.size() > 4000) fault("a message of more than 4000 characters");
  }
}

}  // namespace shoal::tests

/// Stands at the top of a target: FUZZ(const std::string_view input) { read(input); }
#define FUZZ(input)                                                                    \
  static void shoal_fuzz(input);                                                       \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {  \
    shoal::tests::must_answer([&] { shoal_fuzz(shoal::tests::text_of(data, size)); }); \
    return 0;                                                                          \
  }                                                                                    \
  static void shoal_fuzz(input)
