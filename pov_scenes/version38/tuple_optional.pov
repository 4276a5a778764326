// A value for an optional name may be left out.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -6> look_at 0 }
light_source { <5, 8, -6>, 0.8 }
#declare (P, optional Q) = (0.9, );
#declare (S, optional T) = (0.4, Undeclared);
sphere { -1.5*x, P }
#ifdef (Q) sphere { 0, 1 } #end
sphere { 1.5*x, S }
#ifdef (T) sphere { 0, 1 } #end
