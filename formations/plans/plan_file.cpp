#include "shoal/core/csv_table.hpp"
#include "shoal/formations/plan.hpp"

namespace shoal::formations {
namespace {

/// A plan from a CSV file with the columns name, x_m and y_m.
struct PlanFile final : PlanSource {
  FilePath path;
  Origin origin;

  static void declare(Options<PlanFile>& o) {
    o.file("path", &PlanFile::path, "CSV file with the columns name,x_m,y_m");
  }

  Plan plan() const override {
    if (path.path.empty()) {
      throw InputError(origin, "this plan needs a file; set plan.file.path");
    }
    if (path.path.string().starts_with("library:")) {
      throw InputError(path.origin,
                       path.path.string() + ": the library has no plans; name a CSV file");
    }
    const CsvTable table(path, {.required = {"name", "x_m", "y_m"}, .optional = {}});
    const std::vector<double> x = table.numbers("x_m");
    const std::vector<double> y = table.numbers("y_m");
    std::vector<Eigen::Vector2d> slots;
    for (std::size_t i = 0; i < table.rows(); ++i) slots.emplace_back(x[i], y[i]);

    // The plan itself would refuse these too, but it knows no lines.
    std::vector<std::string> names = table.texts("name");
    if (const auto pair = same_name(names)) {
      complain(table, *pair, "has the same name \"" + names[index(pair->first)] + '"');
    }
    if (const auto pair = same_place(slots)) complain(table, *pair, "is at the same place");
    return Plan(std::move(names), std::move(slots), table.origin(0)).centred();
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  [[noreturn]] static void complain(const CsvTable& table, std::pair<int, int> rows,
                                    const std::string& what) {
    throw InputError(table.origin(index(rows.second)),
                     "this slot " + what + " as that in line " +
                         std::to_string(table.origin(index(rows.first)).line) +
                         "; change one of them");
  }
};

const Register<PlanSource, PlanFile> registered{"file", "slots from a CSV file: name,x_m,y_m"};

}  // namespace
}  // namespace shoal::formations
