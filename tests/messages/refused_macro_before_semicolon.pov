// doubts in lines 3, 4, 5, 6, 8: macro calls behind numbers that are declared or in brackets
#macro Nothing () #end
#declare Size = 2 Nothing ();
#declare List = array [Size Nothing ()] { 1, 2 }
#declare List [1 Nothing ()] = 3;
#declare Up = <0, 1, 0> Nothing ();
#declare Reach = (1 + List [0]);
#declare Ball = sphere { 0, Reach pigment { rgb 1 } } Nothing ();
Ball
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
