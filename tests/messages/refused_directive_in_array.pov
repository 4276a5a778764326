// doubts in lines 3, 4, 5: directives and macros in the list of an array
#macro Size () 2 #end
#declare A = array[2] { 1, Size () }
#declare A = array[2] { #if (1) 1 #end, 2 }
#declare A = array[2][1] { { 1 }, { 1 #debug "a" } }
#declare A = array[2] { (Size ()), 2*Size () }
sphere { 0, A[0] pigment { rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
