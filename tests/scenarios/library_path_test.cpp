#include "shoal/scenarios/library_path.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace shoal::scenarios {
namespace {

namespace fs = std::filesystem;

/// A library of two scenarios and a current, named in SHOAL_LIBRARY while it lives.
struct Library {
  fs::path folder = fs::path(testing::TempDir()) / ("shoal_library_" + std::to_string(getpid()));

  Library() {
    fs::create_directories(folder / "currents");
    for (const char* name : {"b.toml", "a.toml", "notes.txt", "currents/c.nc"}) {
      std::ofstream(folder / name) << "";
    }
    setenv("SHOAL_LIBRARY", folder.c_str(), 1);
  }
  ~Library() {
    unsetenv("SHOAL_LIBRARY");
    fs::remove_all(folder);
  }
};

TEST(LibraryPath, IsTheFolderInTheEnvironment) {
  const Library library;
  EXPECT_EQ(library_path(), library.folder);
  setenv("SHOAL_LIBRARY", "/nowhere/at/all", 1);
  EXPECT_THROW(library_path(), InputError);
}

TEST(LibraryPath, ListsScenariosByNameAndInOrder) {
  const Library library;
  EXPECT_EQ(library_scenarios(), (std::vector<std::string>{"a", "b"}));
}

TEST(LibraryPath, ResolvesFilesOfTheLibraryAndOthers) {
  const Library library;
  EXPECT_EQ(resolved({"library:currents/c.nc", {}}), library.folder / "currents/c.nc");
  EXPECT_EQ(resolved({library.folder / "a.toml", {}}), library.folder / "a.toml");
}

TEST(LibraryPath, SaysWhereAMissingFileWasNamed) {
  const Library library;
  for (const fs::path& path :
       {fs::path("library:currents/d.nc"), library.folder / "d.nc", library.folder, fs::path()}) {
    try {
      resolved({path, {"redsea.toml", 14}});
      FAIL() << path;
    } catch (const InputError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("redsea.toml:14: ")) << error.what();
    }
  }
}

}  // namespace
}  // namespace shoal::scenarios
