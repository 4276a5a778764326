// Only the ends of the steps, in the surfaces of the medium, have any light.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <3, 4, -6>, 1 }
sphere {
  0, 1 hollow pigment { rgbf 1 } finish { ambient 0 diffuse 0 } scale 1.5
  interior {
    media {
      scattering { 1, 0.8 } method 3 samples 3, 3 intervals 1
      density { spherical color_map { [0 rgb 1] [0.02 rgb 1] [0.02 rgb 0] } scale 1.5 }
    }
  }
}
