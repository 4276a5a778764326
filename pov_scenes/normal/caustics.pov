// Normal: caustics and total reflection go by tilted normals.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { angle 65 location <0, 6, -15> right 4/3*x look_at <0, 2, 0> }
light_source { <0, 50, 0>, 1 }
plane { y, 0 pigment { rgb 0.6 } finish { ambient 0.1 diffuse 0.7 } }
plane { y, 10
  hollow
  pigment { rgbf <0.7, 0.7, 1, 0.9> }
  finish { reflection 0.7 }
  interior { ior 1.1 caustics 1 }
  normal { bumps 0.5 }
}
