// Options that take one of a few names.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "dlm/kernel.h"

namespace lucarne {

/// Adds an option whose value is one of the names; another is refused in one line that lists them.
template <class T>
CLI::Option* addChoice(CLI::App& cmd, const std::string& name, T& target, const std::map<std::string, T>& choices,
                       const std::string& defaultName, const std::string& help) {
  const auto choose = [&target, choices, name](const std::string& text) {
    if (const auto at = choices.find(text); at != choices.end()) {
      target = at->second;
      return;
    }
    std::string all;
    for (const auto& [choice, value] : choices) all += (all.empty() ? "" : ", ") + choice;
    throw CLI::ValidationError(name, "'" + text + "' is none of " + all);
  };
  return cmd.add_option_function<std::string>(name, choose, help)->type_name("NAME")->default_str(defaultName);
}

inline std::map<std::string, KernelShape> kernelShapes() {
  return {{"pyramid", KernelShape::pyramid},
          {"box", KernelShape::box},
          {"epanechnikov", KernelShape::epanechnikov},
          {"adaptive", KernelShape::adaptive},
          {"linear", KernelShape::linear}};
}
inline constexpr const char* kDropHelp =
    "leave out maps of faint directions, and the colour of neutral ones: at no texel do reflections lose more light than this share of its irradiance, or of "
    "its surface's mean, e.g. 0.5%";
inline constexpr const char* kKernelHelp =
    "reconstruction kernel: pyramid, box, epanechnikov; linear: fits a plane, sharper at edges; or adaptive: at each texel the "
    "width of least expected error";

}  // namespace lucarne
