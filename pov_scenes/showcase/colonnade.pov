// A colonnade in late light: fluted columns under an architrave, on a stepped base.
// size: 320x240
#version 3.7;
global_settings { assumed_gamma 1 }
background { rgb <0.55, 0.68, 0.85> }
camera { location <-5.5, 2.1, -11> look_at <1.2, 2.6, 1> angle 52 }
light_source { <-90, 70, -60>, rgb <1.25, 1.1, 0.85> }
light_source { <40, 60, -80>, rgb <0.15, 0.18, 0.25> shadowless }

#declare Stone = texture { pigment { rgb <0.82, 0.74, 0.6> } finish { ambient 0.12 diffuse 0.65 } };
#declare Column = union {
  box { <-0.62, 0, -0.62>, <0.62, 0.2, 0.62> }
  torus { 0.47, 0.1 translate 0.3*y }
  difference {
    cone { 0.22*y, 0.48, 4.4*y, 0.38 }
    #for (I, 0, 15)
      cone { <0.5, 0.5, 0>, 0.075, <0.4, 4.25, 0>, 0.06 rotate 22.5*I*y }
    #end
  }
  torus { 0.38, 0.07 translate 4.38*y }
  cone { 4.4*y, 0.4, 4.65*y, 0.6 }
  box { <-0.62, 4.65, -0.62>, <0.62, 4.85, 0.62> }
};

union {
  #for (I, 0, 5)
    object { Column translate <I*2 - 3, 0, 0> }
    object { Column translate <I*2 - 3, 0, 4> }
  #end
  #for (I, 0, 2)
    box { <-4 - 0.35*I, -0.25*(I + 1), -1 - 0.35*I>, <8 + 0.35*I, -0.25*I - 0.001, 5 + 0.35*I> }
  #end
  box { <-3.7, 4.851, -0.6>, <7.7, 5.4, 0.6> }
  box { <-3.7, 4.851, 3.4>, <7.7, 5.4, 4.6> }
  box { <-3.9, 5.401, -0.8>, <7.9, 5.6, 4.8> }
  texture { Stone }
}
sphere { <2, 0.901, 2>, 0.9 pigment { rgb <0.05, 0.06, 0.06> } finish { ambient 0 diffuse 0.3 specular 0.6 reflection { 0.25, 0.8 falloff 2 } } }
plane { y, -0.76 pigment { brick rgb <0.5, 0.43, 0.33>, rgb <0.66, 0.58, 0.45> brick_size <1.5, 1, 1.1> mortar 0.05 translate 0.4*y } finish { ambient 0.1 diffuse 0.6 } }
