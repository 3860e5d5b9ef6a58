flat in uint outTurn;

layout(location = 0) out uint turn;

void main()
{
    turn = outTurn;
}
