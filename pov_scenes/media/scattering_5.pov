// Media: scattering mostly forward, in a block that bends light; half of it is missing behind.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 angle 40 }
light_source { <5, 8, -10>, 1 }
background { rgb <0.2, 0.3, 0.4> }
plane { y, -1.07 hollow pigment { checker rgb 0.8 rgb 0.5 } }
box { -0.8, 0.8 hollow pigment { rgbt 1 } finish { reflection 0.1 } interior { ior 1.2 media { absorption 0.5 scattering { 5, 0.6 eccentricity 0.4 extinction 0.5 } } } }
sphere { <0.2, 0, 0>, 0.3 pigment { rgb x } }
