#pragma once

/// The version of shoal, and a number that rises with every change of a public header that a
/// library built against it could notice.
#define SHOAL_ABI "0.1.0-2"

/// Makes a shared library a plugin: once, at the top level of one of its sources.
///
///     #include <shoal/core/plugin.hpp>
///     SHOAL_PLUGIN
///
/// Its members register themselves by constants of the type Register, as those of shoal do.
/// A library built against another shoal is refused before any of its code runs.
#define SHOAL_PLUGIN                                                                       \
  extern "C" __attribute__((used, visibility("default"))) const char shoal_plugin_mark[] = \
      "shoal plugin, ABI " SHOAL_ABI ";";
