// A clear isosurface.
// compare: channel<=2 pixels<=0.2% because "POV-Ray has no shadows of what is nearer than 0.001, ten times the accuracy here"
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <1, 1.5, -4> look_at 0 angle 45 }
light_source { <-3, 5, -8> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
plane { z, 3 pigment { checker rgb 1, rgb 0.6 } }
isosurface { function { sqrt(x*x + z*z) - 0.6 + 0.1*sin(12*y) } max_gradient 2 accuracy 0.0001 pigment { rgbt <0.9, 0.7, 0.4, 0.7> } }
