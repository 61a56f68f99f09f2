#include "shoal/analysis/statistics/paired_test.hpp"
#include "shoal/analysis/statistics/power.hpp"

namespace shoal::analysis::statistics {
namespace {

struct Student final : PairedTest {
  std::string title() const override { return "paired t"; }
  std::string short_title() const override { return "t"; }
  std::string column_ending() const override { return "t"; }

  std::optional<TestResult> test(const Differences& differences) const override {
    return paired_t_test(differences);
  }
  double least_p_value(int) const override { return 0.0; }
  double power(int n, double effect, double alpha) const override {
    return paired_t_power(n, effect, 1.0, alpha);
  }
  std::unique_ptr<PairedTest> beside() const override { return randomisation_test(); }

  static void declare(Options<Student>&) {}
};

const Register<PairedTest, Student> registered{"paired_t",
                                               "Student's t test, exact for normal differences"};

}  // namespace

std::unique_ptr<PairedTest> student_test() {
  return std::make_unique<Student>();
}

std::unique_ptr<PairedTest> PairedTest::beside() const {
  return student_test();
}

}  // namespace shoal::analysis::statistics
