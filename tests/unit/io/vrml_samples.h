// Scenes in VRML, of both versions.
#pragma once

namespace holdfast::samples {

// As CAD programs export it: a mantle of quadrangles, and a node that is used again and rotated.
inline const char* const kVrml2 = R"(#VRML V2.0 utf8
# a comment {
WorldInfo { title "a # no comment, } no end" info [ "x" "y \" z" ] }
NavigationInfo { type [ "EXAMINE", "ANY" ] headlight TRUE }
PROTO Knob [ field SFFloat size 1 eventIn SFBool on ] { Sphere { radius IS size } }
EXTERNPROTO Other [ ] [ "urn:other" ]
DEF T Transform {
  translation 10 0 0
  scale 2 2 2
  children [
    DEF cube Shape {
      appearance Appearance { material Material { diffuseColor 1 0 0, transparency 0.5 } }
      geometry DEF faces IndexedFaceSet {
        solid TRUE ccw TRUE convex TRUE
        coord DEF c Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0, 0 0 1, 1 0 1, 1 1 1, 0 1 1 ] }
        coordIndex [ 0 3 2 1 -1, 4 5 6 7 -1 0,1,5,4,-1 1 2 6 5 -1 2 3 7 6 -1 3 0 4 7 ]
        texCoordIndex [ 0 ]
      }
    }
    Script { field SFNode n USE cube eventOut SFBool b url "javascript: { }" }
    Knob { size 3 }
  ]
}
DEF mirrored Transform { center 0 0 1 rotation 0 0 1 1.5707963267948966 scale -1 1 1 children USE cube }
Switch { whichChoice 2 choice [ Shape { geometry USE faces } NULL Group { children Shape { geometry Cylinder { height 1 } } } ] }
LOD { range [ 5 ] level [ Group { } Shape { geometry USE faces } ] }
Inline { url "other.wrl" }
DEF clock TimeSensor { loop TRUE }
ROUTE clock.fraction_changed TO T.set_scale
)";

// Nodes of version 1 change the nodes that follow them.
inline const char* const kVrml1 = R"(#VRML V1.0 ascii
Separator {
  ShapeHints { vertexOrdering CLOCKWISE shapeType SOLID }
  FontStyle { style (BOLD | ITALIC) }
  Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0, 0 0 1 ] }
  Separator {
    Translation { translation 5 0 0 }
    DEF one IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 3, 1, -1, 1, 3, 2, -1, 2, 3, 0, -1 ] }
  }
  Separator {
    MatrixTransform { matrix 1 0 0 0  0 1 0 0  0 0 1 0  0 7 0 1 }
    Scale { scaleFactor 1 1 3 }
    USE one
  }
  Switch { whichChild -3 Sphere { radius 1 } Cone { } }
  Switch { Cone { } }
  TransformSeparator { Transform { translation 1 1 1 } }
  DEF last IndexedFaceSet { coordIndex [ 0, 1, 2 ] }
})";

/// X3D in the syntax of VRML97.
inline const char* const kX3dv =
    "#X3D V3.0 utf8\nPROFILE Immersive\nCOMPONENT Geometry3D:2\nMETA \"a\" \"b\"\nUNIT angle degree 0.017\n"
    "DEF part Transform { translation 1 0 0 children [ Shape { geometry IndexedTriangleSet { index [0 1 2 0 "
    "2 "
    "3]\ncoord Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0 1 0] } } }\nSwitch { whichChoice 0 children Group "
    "{ } } "
    "] }\nEXPORT part AS b\nDEF new Effect { inputOutput SFVec3f a 0 1 0 inputOnly SFTime time parts [ ] }\n";

}  // namespace holdfast::samples
