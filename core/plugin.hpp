#pragma once

/// Makes a shared library a plugin: once, at the top level of one of its sources.
///
///     #include <shoal/core/plugin.hpp>
///     SHOAL_PLUGIN
///
/// Its members register themselves by constants of the type Register, as those of shoal do.
/// SHOAL_ABI comes with the target that is linked: a library built against another shoal is refused
/// before any of its code runs.
#define SHOAL_PLUGIN                                                                       \
  extern "C" __attribute__((used, visibility("default"))) const char shoal_plugin_mark[] = \
      "shoal plugin, ABI " SHOAL_ABI ";";
