// Helpers of the tests of world files: files that exist during a test, and fake estimators.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "worlds/film_layers.hpp"
#include "worlds/load.hpp"

namespace worlds::test {

/// A temporary folder; it is deleted with the object.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "worlds_test_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, std::string_view text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Stand-ins with the names and some of the options of the real ones.
inline EstimatorSchemas fake_estimators() {
  EstimatorSchemas schemas;
  schemas.types["ekf"] = [](Fields& fields, std::map<std::string, OptionValue>& options) {
    double gate = 0.0;
    fields.number("gate", gate, at_least(0), "of observations");
    options["gate"] = gate;
  };
  schemas.types["seif"] = schemas.types["ekf"];
  schemas.types["multi_seif"] = schemas.types["ekf"];
  schemas.types["seif_report"] = [](Fields& fields, std::map<std::string, OptionValue>& options) {
    std::int64_t theta_x = 6;
    std::int64_t recovered = 10;
    fields.integer("theta_x", theta_x, at_least(1), "active landmarks");
    fields.integer("K", recovered, at_least(0), "landmarks recovered beside the active ones");
    options["theta_x"] = theta_x;
    options["K"] = recovered;
  };
  return schemas;
}

inline std::filesystem::path gallery_file(const std::string& name) {
  return std::filesystem::path(SEIFBED_SOURCE_DIR) / "worlds" / (name + ".yaml");
}

inline const std::vector<std::string>& gallery() {
  static const std::vector<std::string> names = {"courtyard", "report2002", "loop",     "orchard",
                                                 "forest",    "walls",      "slippery", "umbmark",
                                                 "faults",    "team",       "fleet"};
  return names;
}

/// The messages, a line for each.
inline std::string text_of(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += to_string(problem) + '\n';
  return text;
}

/// One of the problems has this message. `what` was tried.
inline void expect_refused(const LoadResult& result, const std::string& message, const std::string& what) {
  EXPECT_FALSE(result.world) << what;
  EXPECT_NE(text_of(result.problems).find(message), std::string::npos) << what << '\n'
                                                                       << text_of(result.problems);
}

inline void expect_equal(const Film& a, const Film& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.fps, b.fps);
  EXPECT_EQ(a.speed, b.speed);
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.eye, b.eye);
  EXPECT_EQ(a.target, b.target);
  EXPECT_EQ(a.estimators, b.estimators);
  for (const FilmLayer& layer : film_layers)
    EXPECT_EQ(a.layers.*layer.shown, b.layers.*layer.shown) << layer.name;
}

inline LoadResult load_text(const Folder& folder, std::string_view text,
                            const std::vector<std::string>& overrides = {}) {
  return load_world(folder.write("world.yaml", text), overrides, fake_estimators());
}

}  // namespace worlds::test
