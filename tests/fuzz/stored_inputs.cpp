// Runs a fuzz target on files, without libFuzzer: inputs that failed once are tested with any compiler.
//
//   TARGET FOLDER_OR_FILE...
#include <iterator>
#include <vector>

#include "bytes.h"

namespace {

void run(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  holdfast::fuzz::require(file.good() || file.eof(), "cannot read " + path.string());
  std::fprintf(stderr, "%s\n", path.c_str());  // the last line of a process that crashes
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

int main(int count, char** arguments) {
  std::size_t inputs = 0;
  for (int k = 1; k < count; ++k) {
    std::vector<std::filesystem::path> paths;
    if (std::filesystem::is_directory(arguments[k]))
      for (const auto& entry : std::filesystem::directory_iterator(arguments[k]))
        paths.push_back(entry.path());
    else
      paths.emplace_back(arguments[k]);
    std::sort(paths.begin(), paths.end());
    for (const auto& path : paths) run(path);
    inputs += paths.size();
  }
  holdfast::fuzz::require(inputs > 0, "no inputs");
  std::fprintf(stderr, "%zu inputs\n", inputs);
  return 0;
}
