// Five kinds of solids nested five deep.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
difference {
  union {
    intersection {
      merge {
        difference {
          box { <-1.3, -0.8, -0.8>, <0.7, 0.8, 0.8> }
          sphere { <-1.3, 0, -0.8>, 0.6 }
        }
        cylinder { <0, 0, 0>, <1.6, 0, 0>, 0.6 }
      }
      sphere { 0, 1.35 }
    }
    torus { 0.8, 0.25 rotate 90*z translate 0.9*x }
  }
  cylinder { <0, -2, -0.2>, <0, 2, -0.2>, 0.4 }
  rotate <-20, 25, 0>
  pigment { rgb <0.6, 0.7, 0.9> }
}
