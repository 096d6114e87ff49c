// Lengths and hashes of the files of a .dlm folder, so that a damaged or altered one is found before it is believed.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lucarne {

/// {"NAME": {"bytes": …, "xxh3_128": "…"}, …} of files in a folder, for the manifest's "files".
nlohmann::json sealFiles(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Checks a file against the manifest's "files" where that has an entry for it. InputError names the file.
void checkSeal(const nlohmann::json& manifest, const std::filesystem::path& folder, const std::string& name);

}  // namespace lucarne
