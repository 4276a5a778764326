// A spindle torus: the minor radius is larger and the inner lemon is part of the surface, as glass shows.
// compare: channel<=22 pixels<=2.9% because "POV-Ray takes normals of the inner lemon from the near side of the circle, where its centre of curvature is not"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
torus { 0.5, 0.8 rotate -30*x translate -1.2*x pigment { rgb <0.3, 0.7, 0.5> } }
torus { 0.5, 0.8 rotate -30*x translate 1.2*x pigment { rgbf <0.9, 0.7, 0.5, 0.6> } }
