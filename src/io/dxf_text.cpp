#include "io/dxf_text.h"

namespace holdfast::io {

DxfText::DxfText(const Source& source) : text_(source, '\0') {
  if (source.bytes.starts_with("AutoCAD Binary DXF"))
    throw FileError(source.path, "", "a binary DXF; save it as text");
  has_group_ = read_group(group_);
}

bool DxfText::read_group(DxfGroup& group) {
  beat(text_.source().watch);
  if (text_.at_end()) return false;
  const std::string_view code = trimmed(text_.rest_of_line());
  group.code = id_of(text_, code, "the code of a group");
  if (text_.remaining().empty()) text_.fail_truncated("the value of a group");
  group.value = trimmed(text_.rest_of_line());
  group.place = text_.last();
  return true;
}

bool DxfText::next(DxfEntity& entity) {
  while (has_group_ && group_.code != 0) has_group_ = read_group(group_);
  if (!has_group_) return false;
  entity.type = group_.value;
  entity.place = group_.place;
  entity.groups.clear();
  while ((has_group_ = read_group(group_)) && group_.code != 0) entity.groups.push_back(group_);
  return true;
}

const DxfGroup* DxfText::find(const DxfEntity& entity, int code) {
  for (const DxfGroup& group : entity.groups)
    if (group.code == code) return &group;
  return nullptr;
}

std::string_view DxfText::text(const DxfEntity& entity, int code) {
  const DxfGroup* const group = find(entity, code);
  return group == nullptr ? std::string_view() : group->value;
}

// Numbers are read at their place, for errors; then reading goes on behind the entity.

std::int64_t DxfText::integer(const DxfGroup& group) {
  const std::size_t behind = text_.position();
  text_.seek(group.place);
  const std::int64_t value = integer_of(text_, group.value, "an integer");
  text_.seek(behind);
  return value;
}

double DxfText::real(const DxfGroup& group) {
  const std::size_t behind = text_.position();
  text_.seek(group.place);
  const double value = real_of(text_, group.value, "a number");
  text_.seek(behind);
  return value;
}

std::int64_t DxfText::integer(const DxfEntity& entity, int code, std::int64_t otherwise) {
  const DxfGroup* const group = find(entity, code);
  return group == nullptr ? otherwise : integer(*group);
}

double DxfText::real(const DxfEntity& entity, int code, double otherwise) {
  const DxfGroup* const group = find(entity, code);
  return group == nullptr ? otherwise : real(*group);
}

Point DxfText::point(const DxfEntity& entity, int code) {
  return {real(entity, code, 0), real(entity, code + 10, 0), real(entity, code + 20, 0)};
}

}  // namespace holdfast::io
