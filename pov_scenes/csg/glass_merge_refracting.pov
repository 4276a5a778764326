// A refracting merge bends rays only at its outside; the union beside it at every surface.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 2, -6> look_at 0 angle 38 }
light_source { <-4, 6, -8>, rgb 1 }
plane { y, -1.01 pigment { checker rgb 0.9, rgb <0.3, 0.4, 0.5> } }
#declare Glass = texture { pigment { rgbf <0.95, 0.95, 0.98, 0.9> } };
merge { sphere { <-0.3, 0, 0>, 0.6 } sphere { <0.3, 0.1, 0>, 0.6 } texture { Glass } interior { ior 1.3 } translate -1.2*x }
union { sphere { <-0.3, 0, 0>, 0.6 } sphere { <0.3, 0.1, 0>, 0.6 } texture { Glass } interior { ior 1.3 } translate 1.2*x }
