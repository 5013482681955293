#include "harness/film/poster.hpp"

#include <system_error>

#include "harness/figures/piped_program.hpp"
#include "harness/files/output_file.hpp"
#include "harness/recording/run_folder.hpp"

namespace harness {

std::string poster_of(const std::filesystem::path& film) try {
  const TemporaryFolder folder;
  const std::filesystem::path picture = folder / "poster.jpg";
  // Decodes the last two seconds; each frame overwrites the one before.
  PipedProgram ffmpeg({"ffmpeg",
                       "-loglevel",
                       "error",
                       "-nostdin",
                       "-y",
                       "-threads",
                       "1",
                       "-sseof",
                       "-2",
                       "-i",
                       "file:" + film.string(),
                       "-vf",
                       "scale=min(1280\\,iw):-2",
                       "-update",
                       "1",
                       "-q:v",
                       "4",
                       "-bitexact",
                       "-threads",
                       "1",
                       "file:" + picture.string()});
  return ffmpeg.finish() && std::filesystem::exists(picture) ? read_whole_file(picture) : std::string();
} catch (const std::system_error&) {
  return {};
}

}  // namespace harness
