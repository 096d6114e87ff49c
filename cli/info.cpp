#include "app/info.h"

#include <cstdio>
#include <memory>

#include "app/contact_sheet.h"
#include "base/json.h"
#include "cli/commands.h"

namespace lucarne {

void addInfo(CLI::App& app, Action& action) {
  CLI::App* cmd = app.add_subcommand("info", "tell what is in a .dlm, a .part, a scene or an .exr/.hdr image");
  const auto path = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  cmd->add_option("PATH", *path, "the file or folder")->required();
  cmd->add_flag("--json", *json, "as JSON");
  const auto picture = std::make_shared<std::string>();
  cmd->add_option("--picture", *picture,
                  "of a .dlm: write its atlas as one PNG: irradiance, error, photons and the light of each direction");
  const auto scene = std::make_shared<std::string>();
  cmd->add_option("--scene", *scene,
                  "of a .part or .dlm: does it still match this scene file? if not, what differs, in words; cameras and "
                  "names do not count");
  cmd->callback([=, &action] {
    action = [=] {
      nlohmann::json d = describe(*path);
      if (!scene->empty()) d["compared_with_scene"] = compareWithScene(*path, *scene);
      if (!picture->empty()) writeContactSheet(*path, *picture);
      const std::string text = *json ? dumpJson(d) : toText(d);
      std::fputs(text.c_str(), stdout);
      if (!text.ends_with('\n')) std::fputc('\n', stdout);
    };
  });
}

}  // namespace lucarne
