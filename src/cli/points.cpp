// Reading plain points: .xyz, or the vertices of a surface.
#include <fmt/core.h>

#include <charconv>
#include <fstream>

#include "files.h"

namespace holdfast::cli {
namespace {

/// The numbers of a text file, line by line; comments from '#' on and empty lines are skipped.
class NumberLines {
 public:
  explicit NumberLines(const std::filesystem::path& path) : path_(path), file_(path) {
    if (!file_) throw FileError(path, "", "cannot be opened for reading");
  }

  /// Reads the numbers of the next line that has any; false at the end of the file.
  bool next(std::vector<double>& numbers) {
    std::string line;
    while (std::getline(file_, line)) {
      ++number_;
      parse(line.substr(0, line.find('#')), numbers);
      if (!numbers.empty()) return true;
    }
    if (file_.bad()) fail("cannot be read");
    return false;
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw FileError(path_, fmt::format("line {}", number_), reason);
  }

 private:
  void parse(const std::string& line, std::vector<double>& numbers) {
    numbers.clear();
    const char* at = line.data();
    const char* const end = at + line.size();
    for (;;) {
      while (at != end && (*at == ' ' || *at == '\t' || *at == ',' || *at == '\r')) ++at;
      if (at == end) return;
      if (*at == '+') ++at;
      double value = 0;
      const auto [stop, error] = std::from_chars(at, end, value);
      const bool ends = stop == end || *stop == ' ' || *stop == '\t' || *stop == ',' || *stop == '\r';
      if (error != std::errc() || !ends) {
        if (numbers.size() >= 3) return;  // a label after the coordinates
        fail(fmt::format("a number is expected at '{}'", std::string(at, end).substr(0, 20)));
      }
      numbers.push_back(value);
      at = stop;
    }
  }

  std::filesystem::path path_;
  std::ifstream file_;
  std::size_t number_ = 0;
};

std::vector<Point> read_xyz(const std::filesystem::path& path) {
  NumberLines lines(path);
  std::vector<Point> points;
  for (std::vector<double> row; lines.next(row);) {
    if (row.size() < 3) lines.fail("three coordinates are expected");
    points.push_back({row[0], row[1], row[2]});
  }
  return points;
}

}  // namespace

std::vector<Point> read_points(const std::filesystem::path& path) {
  if (path.extension() == ".xyz") return read_xyz(path);
  return read_surface(path).vertices;
}

}  // namespace holdfast::cli
