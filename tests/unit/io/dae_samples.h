// Small COLLADA files.
#pragma once

#include <string>

namespace holdfast::samples {

inline std::string dae_file(const std::string& contents) {
  return "<?xml version=\"1.0\"?>\n<COLLADA version=\"1.4.1\"><asset><up_axis>Z_UP</up_axis></asset>" +
         contents + "</COLLADA>\n";
}

/// Vertices, and an input that is not used, two indices for each corner.
inline std::string dae_inputs() {
  return "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><input semantic=\"NORMAL\" source=\"#n\" "
         "offset=\"1\"/>";
}

/// A mesh of five vertices and the given faces.
inline std::string dae_geometry(const std::string& faces) {
  return "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"15\">0 "
         "0 0 1 0 0 "
         "0 1 0 0 0 1 1 1 0</float_array><technique_common><accessor source=\"#a\" count=\"5\" stride=\"3\"/>"
         "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
         "source=\"#p\"/></vertices>" +
         faces + "</mesh></geometry></library_geometries>";
}

inline std::string small_dae() {
  return dae_file(dae_geometry("<polylist count=\"2\" material=\"m\">" + dae_inputs() +
                               "<vcount>4 3</vcount><p>0 0 1 0 4 0 2 0 0 0 3 0 1 0</p></polylist>") +
                  "<library_visual_scenes><visual_scene id=\"s\"><node name=\"n\"><matrix>1 0 0 5 0 -1 0 0 0 "
                  "0 1 0 0 0 0 1"
                  "</matrix><rotate>0 0 1 90</rotate><instance_geometry url=\"#g\"/></node></visual_scene>"
                  "</library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene>");
}

}  // namespace holdfast::samples
