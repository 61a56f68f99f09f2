#include <optional>

#include "shoal/core/angles.hpp"
#include "shoal/core/csv_table.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/starts/start.hpp"

namespace shoal::scenarios {
namespace {

/// From a CSV file with the columns name, x_m, y_m and, if wanted, heading_deg; one row for every
/// slot of the plan, in any order.
class StartFile final : public StartSource {
 public:
  FilePath path;
  double heading_deg = 180.0;
  Origin origin;

  static void declare(Options<StartFile>& o) {
    o.file("path", &StartFile::path, "CSV file with the columns name,x_m,y_m[,heading_deg]");
    o.number("heading_deg", &StartFile::heading_deg, "deg", in(-360, 360),
             "compass heading of every vehicle, if the file has no column heading_deg");
  }

  std::vector<Start> place(const formations::Plan& plan, const RandomStreams&) const override {
    if (path.path.empty()) {
      throw InputError(origin, "this start needs a file; set swarm.start.file.path");
    }
    const CsvTable table({resolved(path), path.origin},
                         {.required = {"name", "x_m", "y_m"}, .optional = {"heading_deg"}});
    std::vector<std::optional<Start>> found(static_cast<std::size_t>(plan.size()));
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const std::string& name = table.text(row, "name");
      auto& start = found[static_cast<std::size_t>(plan.index_of(name, table.origin(row)))];
      if (start) throw InputError(table.origin(row), name + " starts twice; keep one of the rows");
      const double heading =
          table.has("heading_deg") ? table.number(row, "heading_deg") : heading_deg;
      start = Start{table.number(row, "x_m"), table.number(row, "y_m"), from_compass_deg(heading)};
    }
    std::vector<Start> starts;
    for (int i = 0; i < plan.size(); ++i) {
      const auto& start = found[static_cast<std::size_t>(i)];
      if (!start) {
        throw InputError({path.path.string(), 0},
                         "there is no start for " + plan.name(i) + " of the plan; add a row");
      }
      starts.push_back(*start);
    }
    require_usable(starts, plan, {path.path.string(), 0});
    return starts;
  }
};

const Register<StartSource, StartFile> registered{"file",
                                                  "from a CSV file: name,x_m,y_m[,heading_deg]"};

}  // namespace
}  // namespace shoal::scenarios
