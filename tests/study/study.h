// What the studies of whole scenes share: a scene with the options of a bake, and a main function.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "app/bake_environment.h"
#include "app/bake_scene.h"
#include "app/load_scene.h"
#include "cli/layout_options.h"

namespace lucarne::studies {

/// --scene with the options of layout and sky, and what they name. `texts`: other defaults than a bake's.
class Subject {
 public:
  explicit Subject(CLI::App& app, LayoutTexts texts = {}) : texts_(std::move(texts)) {
    app.add_option("--scene", scene_, "a .glb or .gltf file; none: the built-in room");
    addLayoutOptions(app, options, texts_);
    addSkyOptions(app, options, environment_);
  }
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  /// When the command line has been read.
  void load() {
    finishLayout(options, texts_);
    finishSky(options, environment_);
    if (!scene_.empty()) options.scene = scene_;
    packed = loadScene(options);
    sky = makeEnvironment(loadSky(options), options);
  }

  BakeOptions options;
  PackedScene packed;
  std::unique_ptr<Environment> sky;  // null: none

 private:
  LayoutTexts texts_;
  std::string scene_, environment_;
};

/// What main() returns: `run`'s result, or 1 after a line that tells its error.
template <class Run>
int runStudy(const char* name, Run&& run) {
  try {
    return run();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", name, e.what());
    return 1;
  }
}

}  // namespace lucarne::studies
