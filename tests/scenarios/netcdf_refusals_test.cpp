#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "shoal/scenarios/currents/netcdf_report.hpp"
#include "tests/support/current_files.hpp"

namespace shoal::scenarios {
namespace {

using namespace current_files;

// --- understanding, and refusing -------------------------------------------------------------

TEST(NetcdfCurrent, ConvertsUnitsOfVelocity) {
  const auto speed = [](const std::string& units) {
    File file;
    file.units = units;
    file.velocity = [](double, double, double, double) { return Vector2d(1.0, 0.0); };
    return at(*open(file.write("units.nc")), 0, 0, 0).x();
  };
  for (const char* units : {"m s-1", "m/s", "meter second-1", "m.s-1", "metre/second", "m s^-1"}) {
    EXPECT_EQ(speed(units), 1.0) << units;
  }
  EXPECT_NEAR(speed("cm/s"), 0.01, 1e-9);
  EXPECT_NEAR(speed("cm s-1"), 0.01, 1e-9);
  EXPECT_NEAR(speed("knots"), 0.514444, 1e-6);
  EXPECT_THROW(speed("m"), InputError);
  EXPECT_THROW(speed("furlong/fortnight"), InputError);
  EXPECT_THROW(speed(""), InputError);
}

/// A small file of points x points velocities at some times, none of them written.
fs::path unwritten(const std::string& name, std::size_t points, std::size_t times) {
  const fs::path path = scratch(name);
  int id = 0, dimensions[3] = {}, axes[3] = {};
  const auto require = [](int status) {
    if (status != NC_NOERR) throw std::runtime_error(nc_strerror(status));
  };
  require(nc_create(path.c_str(), NC_CLOBBER | NC_NETCDF4, &id));
  const std::size_t lengths[3] = {times, points, points};
  const char* names[3] = {"time", "y", "x"};
  const std::string units[3] = {"seconds since 2014-12-01", "m", "m"};
  const std::string meanings[3] = {"time", "projection_y_coordinate", "projection_x_coordinate"};
  for (int d = 0; d < 3; ++d) {
    require(nc_def_dim(id, names[d], lengths[d], &dimensions[d]));
    require(nc_def_var(id, names[d], NC_DOUBLE, 1, &dimensions[d], &axes[d]));
    require(nc_put_att_text(id, axes[d], "units", units[d].size(), units[d].c_str()));
    require(nc_put_att_text(id, axes[d], "standard_name", meanings[d].size(), meanings[d].c_str()));
  }
  for (const std::string component : {"u", "v"}) {
    int variable = 0;
    require(nc_def_var(id, component.c_str(), NC_FLOAT, 3, dimensions, &variable));
    require(nc_put_att_text(id, variable, "units", 5, "m s-1"));
  }
  require(nc_enddef(id));
  for (int d = 0; d < 3; ++d) {
    Values values(lengths[d]);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = 100.0 * static_cast<double>(k);
    require(nc_put_var_double(id, axes[d], values.data()));
  }
  require(nc_close(id));
  return path;
}

TEST(NetcdfCurrent, RefusesWhatTakesTooMuchMemoryBeforeItIsRead) {
  EXPECT_SAYS(refusal(unwritten("slab.nc", 1 << 14, 2)), "MB of memory, and 1000 MB are the most");
  const std::string why = refusal(unwritten("times.nc", 1 << 10, 200));
  EXPECT_SAYS(why, "MB of memory, and 1000 MB are the most; cut it to the region and the times");
  EXPECT_EQ(why.find("damaged"), std::string::npos) << why;
  EXPECT_SAYS(refusal(unwritten("little.nc", 4, 2)), "every value is missing");
}

TEST(NetcdfCurrent, FindsVelocitiesByCommonNames) {
  File file;
  file.u_name = file.v_name = "";
  EXPECT_NO_THROW(open(file.write("common.nc")));
}

TEST(NetcdfCurrent, RefusesCommonNamesWithTheStandardNameOfAnotherThing) {
  for (const char* name : {"eastward_wind", "sea_ice_x_velocity", "eastward_sea_ice_velocity",
                           "sea_surface_wave_stokes_drift_eastward_velocity",
                           "eastward_sea_water_velocity_due_to_tides", "ocean_mass_x_transport",
                           "barotropic_eastward_sea_water_velocity_anomaly"}) {
    File file;
    file.u_name = file.v_name = name;
    const std::string why = refusal(file.write("foreign.nc"));
    EXPECT_SAYS(why, "holds no current: u is, by its standard name, " + std::string(name) + ";");
    EXPECT_SAYS(why, "u_variable and v_variable");
    EXPECT_NO_THROW(open(scratch("foreign.nc"), {{"u_variable", plain(std::string("u"))},
                                                 {"v_variable", plain(std::string("v"))}}));
    file.u_name = "";
    EXPECT_SAYS(refusal(file.write("half.nc")), "v is, by its standard name");
  }
}

TEST(NetcdfCurrent, RefusesCommonNamesThatAreDescribedAsAnotherThing) {
  File file;
  file.u_name = file.v_name = "";
  for (const char* words :
       {"Eastward wind at 10 m", "Stokes drift U", "ice drift u", "depth integrated transport u",
        "uncertainty of u", "tidal u", "Error of the eastward ocean current"}) {
    file.u_words = words;
    const std::string why = refusal(file.write("described.nc"));
    EXPECT_SAYS(why, "holds no current: u is, by its long name, \"" + std::string(words) + '"');
    EXPECT_SAYS(why, "u_variable and v_variable");
  }
  for (const char* words :
       {"Eastward current", "zonal velocity", "sea water velocity below the ice",
        "wind-driven ocean current", "device u", "eastward velocity"}) {
    file.u_words = words;
    EXPECT_NO_THROW(open(file.write("described.nc"))) << words;
  }
}

TEST(NetcdfCurrent, RefusesTimesThatAreNoDates) {
  for (const Values& times : {Values{0, 1, 1e15}, Values{-1e15, 0, 1}, Values{0, 1, 1e300}}) {
    File file;
    file.time = times;
    EXPECT_SAYS(refusal(file.write("absurd.nc")), "is no date");
  }
}

TEST(NetcdfCurrent, PrefersTheVariableOfTheDimensionsOwnNameWhereverItStands) {
  File file;
  const auto more_times = [](NetcdfWriter& w) {
    for (const char* name : {"forecast_run", "forecast_offset"}) {
      w.variable(name, NC_DOUBLE, {"time"}, {0, 0, 0}).text("units", "hours since 2014-11-30");
    }
  };
  file.variables = more_times;
  EXPECT_NO_THROW(open(file.write("after.nc")));
  std::swap(file.variables, file.before_time);
  EXPECT_NO_THROW(open(file.write("before.nc")));
}

TEST(NetcdfCurrent, NamesTheCandidatesWhenThereAreTwo) {
  File file;
  file.variables = [](NetcdfWriter& w) {
    w.variable("u2", NC_DOUBLE, {"time", "y", "x"}, Values(36, 0.25))
        .text("standard_name", "surface_eastward_sea_water_velocity")
        .text("units", "m/s");
    w.variable("v2", NC_DOUBLE, {"time", "y", "x"}, Values(36, 0.5))
        .text("standard_name", "surface_northward_sea_water_velocity")
        .text("units", "m/s");
  };
  const std::string why = refusal(file.write("two.nc"));
  EXPECT_SAYS(why, "u and u2 with v and v2");
  const auto water = open(scratch("two.nc"), {{"u_variable", plain(std::string("u2"))},
                                              {"v_variable", plain(std::string("v2"))}});
  EXPECT_EQ(at(*water, 0, 50, 50), Vector2d(0.25, 0.5));
  EXPECT_SAYS(refusal(scratch("two.nc"), {{"u_variable", plain(std::string("u3"))},
                                          {"v_variable", plain(std::string("v2"))}}),
              "did you mean");
  EXPECT_SAYS(refusal(scratch("two.nc"), {{"u_variable", plain(std::string("u2"))}}), "together");
}

TEST(NetcdfCurrent, RefusesStaggeredAndCurvilinearGrids) {
  const auto write = [](const std::string& name, bool staggered) {
    NetcdfWriter w(scratch(name));
    w.dimension("eta", 3).dimension("xi", 3).dimension("xi_v", 2);
    w.variable("lon", NC_DOUBLE, {"eta", "xi"}, {0, 1, 2, 0, 1, 2, 0, 1, 3})
        .text("units", "degrees_east");
    w.variable("lat", NC_DOUBLE, {"eta", "xi"}, {0, 0, 0, 1, 1, 1, 2, 2, 2})
        .text("units", "degrees_north");
    w.variable("u", NC_DOUBLE, {"eta", "xi"}, Values(9, 0.0))
        .text("standard_name", "sea_water_x_velocity")
        .text("units", "m/s");
    w.variable("v", NC_DOUBLE, {"eta", staggered ? "xi_v" : "xi"}, Values(9, 0.0))
        .text("standard_name", "sea_water_y_velocity")
        .text("units", "m/s");
    w.finish();
    return refusal(scratch(name));
  };
  EXPECT_SAYS(write("curvilinear.nc", false), "u(eta, xi) stands on a curvilinear grid");
  EXPECT_SAYS(write("staggered.nc", true), "staggered (Arakawa C) grid");
}

TEST(NetcdfCurrent, RefusesAxesItWouldHaveToGuess) {
  File file;
  file.x_units = "";
  EXPECT_SAYS(refusal(file.write("no_units.nc")), "the axis x has no units");
  file.x_units = "furlongs";
  EXPECT_SAYS(refusal(file.write("furlongs.nc")), "furlongs");
  file = File{};
  file.x = {0, 200, 100};
  EXPECT_SAYS(refusal(file.write("jumping.nc")), "x is not strictly monotonic");
  file.x = {0};
  EXPECT_SAYS(refusal(file.write("point.nc")), "a single point");
  file = File{};
  std::swap(file.x_units, file.time_units);
  EXPECT_NE(refusal(file.write("swapped.nc")), "");
}

TEST(NetcdfCurrent, RefusesDimensionsInAnotherOrder) {
  NetcdfWriter w(scratch("order.nc"));
  w.dimension("x", 2).dimension("y", 2);
  w.variable("x", NC_DOUBLE, {"x"}, {0, 1}).text("units", "m").text("axis", "X");
  w.variable("y", NC_DOUBLE, {"y"}, {0, 1}).text("units", "m").text("axis", "Y");
  w.variable("u", NC_DOUBLE, {"x", "y"}, Values(4, 0.0)).text("units", "m/s");
  w.variable("v", NC_DOUBLE, {"x", "y"}, Values(4, 0.0)).text("units", "m/s");
  w.finish();
  EXPECT_SAYS(refusal(scratch("order.nc")), "in the order time, depth, y, x");
}

TEST(NetcdfCurrent, RefusesFilesThatAreNone) {
  EXPECT_SAYS(refusal(scratch("missing.nc")), "there is no file");
  EXPECT_SAYS(refusal(scratch("missing.nc").parent_path()), "is a folder");
  std::ofstream(scratch("text.nc")) << "u,v\n1,2\n";
  EXPECT_SAYS(refusal(scratch("text.nc")), "text.nc: is not a netCDF file");
  std::ofstream(scratch("empty.nc")).close();
  EXPECT_SAYS(refusal(scratch("empty.nc")), "is not a netCDF file");
  EXPECT_SAYS(complaint([] { Registry<Current>::instance().make("netcdf", {}, "current.netcdf"); }),
              "no file is named");
}

TEST(NetcdfCurrent, RefusesTruncatedFilesOfEveryFormat) {
  for (const int format : {0, NC_64BIT_OFFSET, NC_NETCDF4}) {
    const fs::path path = File{}.write("whole.nc", format);
    EXPECT_NO_THROW(open(path));
    const auto size = fs::file_size(path);
    for (const auto kept : {size - 8, size / 2, std::uintmax_t{6}}) {
      fs::copy_file(path, scratch("cut.nc"), fs::copy_options::overwrite_existing);
      fs::resize_file(scratch("cut.nc"), kept);
      EXPECT_NE(refusal(scratch("cut.nc")), "") << format << " " << kept;
    }
  }
}

// --- the report ------------------------------------------------------------------------------

TEST(CurrentReport, SaysWhatWasUnderstood) {
  File file = with_hole(NAN);
  file.depth = {0, 10};
  const std::string text = describe_current_file(file.write("report.nc"));
  EXPECT_SAYS(text, "projected, 3 x 4 points");
  EXPECT_SAYS(text, "x: 3 points from 0 to 200 m, step 100");
  EXPECT_SAYS(text, "2014-12-01T00:00:00Z to 2014-12-01T00:20:00Z, standard calendar");
  EXPECT_SAYS(text, "3 steps over 1200 s, step 600 s");
  EXPECT_SAYS(text, "2 levels from 0 to 10 m");
  EXPECT_SAYS(text, "8.3 % of 72 values");
  EXPECT_SAYS(text, "1.414 to 1.414 m/s, mean velocity (1.000, 1.000) m/s");
}

TEST(CurrentReport, SaysHowVelocitiesArePacked) {
  File file;
  file.type = NC_SHORT;
  file.scale = -1e-4;
  file.offset = 0.5;
  EXPECT_SAYS(describe_current_file(file.write("packed.nc")),
              "u in m s-1, stored as int16 x -1e-04 + 0.5");
}

}  // namespace
}  // namespace shoal::scenarios
