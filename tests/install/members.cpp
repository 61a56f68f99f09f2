// What a build of the planner lists, one `family name` a line, and what it says of a member that
// was left out.

#include <cstdio>
#include <cstring>
#include <shoal/core/error.hpp>
#include <shoal/core/registry.hpp>
#include <shoal/formations/planner.hpp>
#include <shoal/solvers/solver.hpp>

int main() {
  for (const shoal::RegistryBase* family : shoal::families()) {
    for (const shoal::MemberInfo& member : family->members()) {
      std::printf("%s %s\n", family->family().c_str(), member.name.c_str());
    }
  }
  try {
    shoal::Choice<shoal::solvers::Solver>("nlopt.lbfgs").make();
  } catch (const shoal::InputError& error) {
    if (std::strstr(error.what(), "was left out of this build; configure it with -DSHOAL_NLOPT=ON"))
      return 0;
    std::fputs(error.what(), stderr);
  }
  return 1;
}
