// No blanks where none are needed, and line ends in the middle of everything.
#version 3.7;global_settings{assumed_gamma 1}camera{location<0,2,-6>look_at 0angle 38}light_source{<-4,6,-8>rgb 1}
plane{y,-1.01pigment{checker rgb.9,rgb<.3,.4,.5>}}sphere{<-1,0,0>.6pigment{rgb<.9,.5,.2>}}
box
{
<0.5
, -0.5
, -0.5> , <1.5
,0.5,0.5
> pigment{rgb
<.3
.6
.9>}}
